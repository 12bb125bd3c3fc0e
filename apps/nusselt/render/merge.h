#pragma once
/// `nusselt merge`: one image of images.

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

/// Puts images of parts or seeds together.
int run_merge(const MergeOptions& options);

} // namespace nusselt::app
