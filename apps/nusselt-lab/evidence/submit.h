#pragma once
/// `nusselt-lab submit` divides sweeps among many machines.

#include "apps/common/jobs/submit.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

/// Images for each scene, technique and seed.
struct SubmitImagesOptions {
    std::vector<std::filesystem::path> scenes;
    std::vector<std::string> techniques;
    std::vector<std::string> render_options; ///< as `nusselt render` takes them
    int seeds = 1;
    std::filesystem::path output; ///< folder
    SubmitOptions job;
};

/// Shards of a search for errors.
struct SubmitShardsOptions {
    std::vector<std::string> options; ///< as the command takes them
    std::uint64_t count = 0;          ///< of configurations or starts, in all shards together
    std::uint64_t seed = 1;
    int shards = 1;
    std::filesystem::path output; ///< JSON
    SubmitOptions job;
};

/// Adds the subcommand, whose subcommands store their result in exit_code, which must live until the command line was
/// parsed.
void setup_submit(CLI::App& app, int& exit_code);

int run_submit_images(const SubmitImagesOptions& options);
int run_submit_fuzz(const SubmitShardsOptions& options);
int run_submit_worst_case(const SubmitShardsOptions& options);

} // namespace nusselt::app
