#pragma once
/// `nusselt-lab map TECHNIQUE`: a picture of the map of a technique.

#include <filesystem>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct MapOptions {
    std::string technique; ///< class name
    std::filesystem::path output;
};

/// Adds the subcommand. Its callback stores the result of run_map() in exit_code, which must live until the
/// command line was parsed.
void setup_map(CLI::App& app, int& exit_code);

/// Draws the map of a technique.
int run_map(const MapOptions& options);

} // namespace nusselt::app
