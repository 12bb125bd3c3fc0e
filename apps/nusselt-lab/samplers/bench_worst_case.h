#pragma once
/// `nusselt-lab bench worst-case`

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchWorstCaseOptions {
    std::vector<std::string> targets; ///< empty: all
    std::optional<double> seconds;
    std::optional<std::uint64_t> starts; ///< per target, those in the state file included
    std::optional<std::uint64_t> seed;
    std::optional<int> threads;
    std::optional<std::filesystem::path> state;
    int convergence = 2000;          ///< random lights for the order of convergence
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_worst_case() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_worst_case(CLI::App& bench, int& exit_code);

/// Searches for the largest errors of the iterations and prints or writes them.
/// \returns 0, 1 if one is above its documented bound, or interrupted_exit_code()
int run_bench_worst_case(const BenchWorstCaseOptions& options);

} // namespace nusselt::app
