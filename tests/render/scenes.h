#pragma once
/// Small scenes, and statistics of images, for the tests of the renderer.

#include "image/image.h"
#include "render_cpu/renderer.h"
#include "scene/model/scene.h"

#include <array>
#include <vector>

namespace nusselt::render_test {

using scene::Float3;

/// Adds two triangles. \param light index of a polygonal light, or -1
void add_quad(scene::Scene& scene, const std::array<Float3, 4>& corners, int material, int light = -1);

/// Adds a polygonal light and its surface, which reflects with the given material.
void add_polygon_light(scene::Scene& scene, const std::array<Float3, 4>& corners, const Float3& radiance,
                       bool two_sided, int material);

/// Adds a tube as an emitter of its own.
void add_line_light(scene::Scene& scene, const char* name, scene::LineLight light);

/// A pinhole camera with square pixels. \param tangent of half the field of view along the height
void set_camera(scene::Scene& scene, const Float3& eye, const Float3& target, const Float3& up,
                double tangent, int width, int height);

/// Sets Scene::radius from all coordinates.
void set_radius(scene::Scene& scene);

/// The scene with all lengths multiplied.
scene::Scene scaled(scene::Scene scene, float factor);

/// A matte floor z = 0, seen from above; lights are added by the tests.
scene::Scene make_floor(int size);
inline constexpr float kFloorAlbedo = 0.6f;

/// The open box with two occluders, a panel and a tube; matte and glossy surfaces.
scene::Scene make_box_scene(int size);

/// Two-dimensional cell of an image, averaged over channels and pixels.
std::vector<double> region_means(const image::Image& image, int regions_per_axis);

/// Region means of images with different seeds: one row per seed.
std::vector<std::vector<double>> render_region_means(const render_cpu::Renderer& renderer,
                                                     render::RenderSettings settings, int seed_count,
                                                     const visibility::RayTracer& tracer);

inline constexpr int kRegionsPerAxis = 4;

/// Student's t of the hypothesis that the values have the given mean; 0 if they all equal it up to rounding.
double t_statistic(const std::vector<double>& values, double mean);
/// Welch's t of the hypothesis that both samples have the same mean.
double t_statistic(const std::vector<double>& a, const std::vector<double>& b);

/// Largest |t| over regions. \param expected one value per region
double largest_t(const std::vector<std::vector<double>>& rows, const std::vector<double>& expected);
double largest_t(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b);

/// Student's t with at least 31 degrees of freedom exceeds this with a probability of 1e-5, Sidak-corrected
/// for the number of regions (and below 1e-3 for all tests of this folder together).
inline constexpr double kLargestT = 6.3;
inline constexpr int kSeeds = 32;

} // namespace nusselt::render_test
