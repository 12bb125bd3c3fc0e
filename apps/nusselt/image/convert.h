#pragma once
/// `nusselt convert`: images in other formats.

#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct ConvertOptions {
    std::filesystem::path input;
    std::optional<std::filesystem::path> output; ///< needed unless the layers are listed
    double exposure = 0;                         ///< stops
    std::optional<std::string> layer;            ///< of an EXR file; default: the picture
    bool list_layers = false;
};

/// Adds the subcommand. Its callback stores the result of run_convert() in exit_code, which must live until the
/// command line was parsed.
void setup_convert(CLI::App& app, int& exit_code);

/// Converts an image to another format, or prints the layers of an EXR file.
int run_convert(const ConvertOptions& options);

} // namespace nusselt::app
