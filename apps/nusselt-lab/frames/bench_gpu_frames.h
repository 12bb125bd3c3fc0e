#pragma once
/// `nusselt-lab bench gpu SCENE...`

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchGpuFramesOptions {
    std::vector<std::filesystem::path> scenes; ///< empty: all of the folder
    std::filesystem::path scene_folder = "scenes";
    std::optional<std::string> resolution = "1920x1080";
    std::vector<std::string> techniques;  ///< empty: all
    std::vector<std::string> shadow_rays; ///< ways to trace them; empty: what suits the device, and none
    int frames = 15;                      ///< of each kind
    int warm_up = 3;                      ///< frames of each kind before those
    std::optional<std::string> device;    ///< index, or part of a name
    std::optional<std::string> json;      ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_gpu_frames() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_gpu_frames(CLI::App& bench, int& exit_code);

/// Measures frames of scenes with each technique on a GPU and prints or writes the table.
/// \returns 0, or 1 if a scene could not be measured
int run_bench_gpu_frames(const BenchGpuFramesOptions& options);

} // namespace nusselt::app
