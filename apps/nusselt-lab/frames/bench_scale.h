#pragma once
/// `nusselt-lab bench scale`

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchScaleOptions {
    std::uint64_t triangles = 10'000'000;
    std::uint64_t emissive = 100'000;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_scale() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_scale(CLI::App& bench, int& exit_code);

/// Measures time and memory of large scenes and prints or writes the tables.
int run_bench_scale(const BenchScaleOptions& options);

} // namespace nusselt::app
