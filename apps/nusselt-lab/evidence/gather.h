#pragma once
/// `nusselt-lab gather` puts the results of shards together.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct GatherOptions {
    std::string output; ///< "-" is the standard output
    std::vector<std::filesystem::path> shards;
    std::optional<std::filesystem::path> list; ///< file with the paths of more shards
};

/// Adds the subcommand. Its callback stores the result of run_gather() in exit_code, which must live until the
/// command line was parsed.
void setup_gather(CLI::App& app, int& exit_code);

/// Writes the tables of all shards as one. \returns 0, or 1 if a shard found a violation or an error above its bound
int run_gather(const GatherOptions& options);

} // namespace nusselt::app
