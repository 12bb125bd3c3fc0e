#pragma once
/// Renders comparisons of images and reports them.

#include "image/image.h"
#include "lab/errors/bias_statistics.h"
#include "lab/errors/image_errors.h"
#include "lab/figures/image_comparison.h"
#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

struct VariantResult {
    std::string label;
    image::Image image; ///< the first frame
    /// Of the render phase of a frame. The images of the laboratory are not made to be fast.
    std::optional<double> seconds;
    ImageErrors errors;
    std::optional<BiasTest> bias; ///< if there are several frames of it and of the reference
};

struct ImageComparisonResult {
    ImageComparison comparison;
    image::Image reference;
    double mean = 0;                    ///< of the reference
    double share_outside_penumbrae = 0; ///< of the pixels
    std::vector<VariantResult> variants;
    std::vector<ExpectationResult> expectations;
    std::vector<std::filesystem::path> files; ///< of the scene
};

/// \throws std::runtime_error if the scene cannot be loaded
ImageComparisonResult run_image_comparison(const ImageComparison& comparison, const RunSettings& settings,
                                           const ProgressText& progress);

/// Tables, images with their errors, and numbers.
Report report_of(const ImageComparisonResult& result);

} // namespace nusselt::lab
