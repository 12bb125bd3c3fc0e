#pragma once
/// `nusselt-lab fit-ltc`: tables of linearly transformed cosines.

#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct FitLtcOptions {
    std::string brdf = "frostbite-specular";
    std::string size = "64x64x51"; ///< roughness, inclination, f0
    std::string output;            ///< without extension
    std::optional<std::filesystem::path> checkpoint;
    std::string commit = "unknown";
    std::optional<int> threads;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_fit_ltc() in exit_code, which must live until the
/// command line was parsed.
void setup_fit_ltc(CLI::App& app, int& exit_code);

/// Fits a table of linearly transformed cosines and prints the distribution of its errors.
/// \returns 0, or interrupted_exit_code()
int run_fit_ltc(const FitLtcOptions& options);

} // namespace nusselt::app
