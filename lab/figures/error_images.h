#pragma once
/// Images of backward errors in single precision: C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, Fig. 6, and
/// BRDF Importance Sampling for Linear Lights, Fig. 4.

#include "image/image.h"
#include "lab/figures/technique_image.h"
#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nusselt::lab {

struct ErrorImages {
    std::string name; ///< on the command line
    std::string source;
    std::string description;             ///< one sentence
    std::string scene;                   ///< below the folder of the shipped scenes, see TechniqueImages
    std::vector<std::string> techniques; ///< see TechniqueImages::backward_errors(); ours is the last one
    std::string item;     ///< id of an item of lab/report/published.json, for the residual area
    std::string quantity; ///< as the item names it; empty: it names none
    int width = 0;        ///< of the images in pixels; 0: as the scene defines
};

const std::vector<ErrorImages>& all_error_images();

/// Small images.
ErrorImages quick(ErrorImages experiment);

struct ErrorImagesResult {
    ErrorImages experiment;
    image::Image image;              ///< of the scene
    std::vector<PixelErrors> errors; ///< in the order of the techniques
    std::vector<std::filesystem::path> files;
};

/// \throws std::runtime_error if the scene cannot be loaded
ErrorImagesResult run_error_images(const ErrorImages& experiment, const RunSettings& settings,
                                   const ProgressText& progress);

/// Quantiles, and images on logarithmic scales.
Report report_of(const ErrorImagesResult& result);

} // namespace nusselt::lab
