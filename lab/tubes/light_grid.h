#pragma once
/// Thin lights and the lines that approximate them, over width, distance and roughness: E. Heitz, S. Hill 2017,
/// Linear-Light Shading with Linearly Transformed Cosines, Sec. 1.2.5, Fig. 1.8 and 1.18.

#include "image/image.h"
#include "lab/report/report.h"
#include "lab/report/run_settings.h"
#include "scene/model/lights/line_light.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace nusselt::lab {

/// What is approximated by lines.
enum class GridLight {
    cylinder,  ///< its lateral surface
    rectangle, ///< both sides
};

/// A light above a floor of metal, for each width, distance and roughness. The radiance of the light is inverse to its
/// width, so that all widths have the same line.
struct LightGrid {
    std::string name; ///< on the command line
    std::string source;
    std::string description; ///< one sentence
    GridLight light;
    std::vector<float> radii;       ///< [m], ascending; of rectangles, half the width
    std::vector<float> distances;   ///< of the axis from the floor [m], ascending
    std::vector<float> roughnesses; ///< perceptual, ascending
    int width = 192;                ///< of the images in pixels
    int samples = 256;              ///< per pixel of the reference
};

const std::vector<LightGrid>& all_light_grids();

/// Small images and few samples.
LightGrid quick(LightGrid grid);

/// Ways to approximate the light.
enum class Approximation {
    line,      ///< a line, sampled with the BRDF itself
    analytic,  ///< the line against the fitted lobe, clamped to the whole lobe where the light is a cylinder
    unclamped, ///< the same without the clamp
};

/// Errors of the images, relative to the mean of the reference.
struct GridErrors {
    double rmse;
    double largest; ///< radiance of a pixel, over that of the light
};

struct GridCell {
    float radius, distance, roughness;
    image::Image reference;
    double largest; ///< radiance of a pixel of the reference, over that of the light
    std::vector<image::Image> images;
    std::vector<GridErrors> errors; ///< by Approximation
};

struct LightGridResult {
    LightGrid grid;
    std::vector<GridCell> cells; ///< the radius varies fastest, then the roughness, then the distance
    std::vector<std::filesystem::path> files;
};

/// \throws std::runtime_error if the scene cannot be loaded
LightGridResult run_light_grid(const LightGrid& grid, const RunSettings& settings,
                               const ProgressText& progress);

Report report_of(const LightGridResult& result);

/// The cells of a grid, by their indices.
inline const GridCell& cell(const LightGridResult& result, std::size_t radius, std::size_t distance,
                            std::size_t roughness) {
    const LightGrid& grid = result.grid;
    return result.cells[(distance * grid.roughnesses.size() + roughness) * grid.radii.size() + radius];
}

} // namespace nusselt::lab
