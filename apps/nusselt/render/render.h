#pragma once
/// `nusselt render SCENE`: direct light of a scene.

#include "apps/common/line_options.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct RenderOptions {
    std::filesystem::path scene;
    std::vector<std::filesystem::path> rigs;     ///< in the order in which they are applied
    std::optional<std::filesystem::path> camera; ///< file with another camera
    std::vector<std::filesystem::path> outputs;  ///< empty: named after the film or the scene
    std::optional<int> samples;                  ///< default: what the scene asks for, or 1
    std::string technique = "projected_solid_angle";
    std::optional<std::string> strategies;
    std::optional<std::string> emission_sampling;
    std::optional<std::string> mis;
    std::optional<float> visibility_estimate;
    std::string sampler = "sobol";
    std::optional<int> camera_rays;
    std::string pixel_position = "jittered";
    std::string brdf = "material";
    std::uint32_t seed = 0;
    LineOptions lines;
    std::optional<int> threads;
    std::optional<std::string> resolution; ///< "WIDTHxHEIGHT"
    double exposure = 0;
    bool quiet = false;
    std::optional<std::string> json; ///< "-" is the standard output
    std::optional<std::string> isa;
    std::vector<std::string> layers; ///< names, or "all"
    std::optional<std::string> part; ///< "NUMBER/COUNT"
    std::optional<std::filesystem::path> checkpoint;
    std::optional<double> checkpoint_interval; ///< [s]
    std::optional<std::string> display_server;
    std::string backend = "cpu";
    std::optional<std::string> device;      ///< of the GPU: index, or part of a name
    std::optional<std::string> shadow_rays; ///< on the GPU; default: what suits the device
};

/// Adds the subcommand. Its callback stores the result of run_render() in exit_code, which must live until the
/// command line was parsed.
void setup_render(CLI::App& app, int& exit_code);

/// Adds the argument SCENE and all options.
void add_render_options(CLI::App& command, RenderOptions& options);

/// Renders and writes the images.
/// \returns 0, or interrupted_exit_code()
int run_render(const RenderOptions& options);

} // namespace nusselt::app
