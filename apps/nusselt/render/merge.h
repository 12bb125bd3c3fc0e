#pragma once
/// `nusselt merge` combines images into one.

#include <filesystem>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct MergeOptions {
    std::filesystem::path output;
    std::vector<std::filesystem::path> inputs;
};

/// Adds the subcommand. Its callback stores the result of run_merge() in exit_code, which must live until the
/// command line was parsed.
void setup_merge(CLI::App& app, int& exit_code);

/// Combines images of parts or of several seeds.
int run_merge(const MergeOptions& options);

} // namespace nusselt::app
