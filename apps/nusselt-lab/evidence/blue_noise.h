#pragma once
/// `nusselt-lab blue-noise`: blue noise for dithering.

#include <cstdint>
#include <filesystem>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BlueNoiseOptions {
    double sigma = 1.5; ///< [pixels]
    std::uint64_t seed = 0;
    std::filesystem::path output;
};

/// Adds the subcommand. Its callback stores the result of run_blue_noise() in exit_code, which must live until the
/// command line was parsed.
void setup_blue_noise(CLI::App& app, int& exit_code);

/// Makes blue noise by the void-and-cluster method and writes it as BlueNoiseView reads it.
int run_blue_noise(const BlueNoiseOptions& options);

} // namespace nusselt::app
