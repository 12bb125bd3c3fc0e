#pragma once
/// `nusselt-lab fuzz`

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct FuzzOptions {
    std::vector<std::string> techniques; ///< empty: all
    std::string scalar = "float";
    std::uint64_t seed = 1;
    std::uint64_t first = 0;
    std::uint64_t count = 10'000'000;
    std::optional<int> threads;
    std::optional<std::string> isa;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_fuzz() in exit_code, which must live until the
/// command line was parsed.
void setup_fuzz(CLI::App& app, int& exit_code);

/// Runs techniques on hostile lights and prints what breaks their contract.
/// \returns 0, or 1 if anything does
int run_fuzz(const FuzzOptions& options);

} // namespace nusselt::app
