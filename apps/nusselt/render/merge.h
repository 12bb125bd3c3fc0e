#pragma once
/// `nusselt merge` combines images into one.

#include <filesystem>
#include <optional>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct MergeOptions {
    std::optional<std::filesystem::path> output; ///< without it the first input is meant, as in version 0.1
    std::vector<std::filesystem::path> inputs;
    std::optional<std::filesystem::path> list; ///< file with the paths of more inputs
    bool allows_partial = false;               ///< whether the image may lack pixels
};

/// Adds the subcommand. Its callback stores the result of run_merge() in exit_code, which must live until the
/// command line was parsed.
void setup_merge(CLI::App& app, int& exit_code);

/// Combines images of parts or of several seeds.
int run_merge(const MergeOptions& options);

} // namespace nusselt::app
