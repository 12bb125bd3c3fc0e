#include "blue_noise.h"
#include "apps/common/help.h"
#include "apps/common/validators.h"

#include "base/atomic_file.h"
#include "fit/void_and_cluster.h"

#include <CLI/CLI.hpp>

#include <fstream>
#include <memory>

namespace nusselt::app {

void setup_blue_noise(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<BlueNoiseOptions>();
    CLI::App* command = app.add_subcommand(
        "blue-noise",
        "Make blue noise by the void-and-cluster method: ranks of 64 x 64 pixels of 8 channels.");
    command
        ->add_option("--sigma", options->sigma,
                     "Standard deviation of the Gaussian that measures how crowded a pixel is [pixels]")
        ->check(number(0.5, 8));
    command->add_option("--seed", options->seed, "Seed of the first patterns")
        ->transform(to_whole_number(0, std::uint64_t{1} << 60));
    command
        ->add_option("-o,--output", options->output,
                     "Write the ranks of 16 bits, little-endian, channel by channel and row by row")
        ->type_name("FILE")
        ->required()
        ->group(kOutputGroup);
    command->callback([options, &exit_code] { exit_code = run_blue_noise(*options); });
}

int run_blue_noise(const BlueNoiseOptions& options) {
    base::check_writable(options.output);
    const std::string bytes = fit::make_blue_noise(options.sigma, options.seed);
    base::write_atomically(options.output, [&](std::ofstream& file) { file << bytes; });
    return 0;
}

} // namespace nusselt::app
