#pragma once
/// `nusselt-lab bench shadows`

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchShadowsOptions {
    std::uint64_t seed = 1;
    std::uint64_t first = 0;
    std::uint64_t count = 625'000;
    std::optional<int> threads;
    std::optional<std::string> isa;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_shadows() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_shadows(CLI::App& bench, int& exit_code);

/// Runs the visibility of line samples on hostile occluders and prints what breaks its contract.
/// \returns 0, or 1 if anything does
int run_bench_shadows(const BenchShadowsOptions& options);

} // namespace nusselt::app
