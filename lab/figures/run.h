#pragma once
/// Runs experiments and reports them.

#include "image/image.h"
#include "lab/errors/bias_statistics.h"
#include "lab/errors/image_errors.h"
#include "lab/figures/experiment.h"
#include "lab/figures/report_table.h"
#include "lab/results/results.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

namespace nusselt::lab {

struct VariantResult {
    std::string label;
    image::Image image; ///< the first frame
    double seconds = 0; ///< of the render phase of a frame
    ImageErrors errors;
    std::optional<BiasTest> bias; ///< if there are several frames of it and of the reference
};

struct ExperimentResult {
    const Experiment* experiment = nullptr;
    render::RenderSettings reference_settings;
    image::Image reference;
    double mean = 0;                    ///< of the reference
    double share_outside_penumbrae = 0; ///< of the pixels
    std::vector<VariantResult> variants;
    std::vector<ExpectationResult> expectations;
};

struct RunSettings {
    std::filesystem::path scenes; ///< folder with the shipped scenes
    int reference_samples = 0; ///< per pixel, light and frame of the reference; 0: as the experiment defines
    int width = 0;             ///< of the images in pixels; 0: as the scene defines
    int threads = 0;           ///< 0: all cores
};

/// \param progress called with a line about each step before it is taken.
/// \throws std::runtime_error if a scene cannot be loaded
ExperimentResult run_experiment(const Experiment& experiment, const RunSettings& settings,
                                const std::function<void(std::string_view)>& progress);

/// The numbers of all variants and what became of the expectations, as text.
std::string to_text(const ExperimentResult& result);

/// The numbers alone.
Results results_of(const ExperimentResult& result);

/// Writes a page index.html with a table, the images as PNG and EXR, and numbers.json into a folder, which is created.
void write_report(const ExperimentResult& result, const std::filesystem::path& folder);

} // namespace nusselt::lab
