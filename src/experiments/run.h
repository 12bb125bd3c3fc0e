#pragma once
/// Runs experiments and reports them.

#include "experiments/experiment.h"
#include "image/image.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

namespace nusselt::experiments {

struct VariantResult {
    std::string label;
    image::Image image;
    double seconds = 0; ///< of the render phase
    double rmse = 0;
    double rmse_outside_penumbrae = 0; ///< relative to the mean of the reference
    std::int64_t invalid_pixels = 0;
};

struct ExpectationResult {
    std::string text;
    bool holds = false;
};

struct ExperimentResult {
    const Experiment* experiment = nullptr;
    render_cpu::RenderSettings reference_settings;
    image::Image reference;
    double mean = 0;                    ///< of the reference
    double share_outside_penumbrae = 0; ///< of the pixels
    std::vector<VariantResult> variants;
    std::vector<ExpectationResult> expectations;
};

struct RunSettings {
    std::filesystem::path scenes; ///< folder with the shipped scenes
    int reference_samples = 0;    ///< per pixel and light; 0: as the experiment says
    int width = 0;                ///< of the images in pixels; 0: as the scene says
    int threads = 0;              ///< 0: all cores
};

/// \param progress called with a line about each step before it is taken.
/// \throws std::runtime_error if a scene cannot be loaded
ExperimentResult run_experiment(const Experiment& experiment, const RunSettings& settings,
                                const std::function<void(std::string_view)>& progress);

/// Writes a page index.html with a table and the images as PNG and EXR into a folder, which is created.
void write_report(const ExperimentResult& result, const std::filesystem::path& folder);

} // namespace nusselt::experiments
