#pragma once
/// `nusselt-lab bench phong-lines`

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchPhongLinesOptions {
    int repetitions = 31;
    std::optional<std::string> isa;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_phong_lines() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_phong_lines(CLI::App& bench, int& exit_code);

/// Measures Phong lobes along lines and prints the table.
int run_bench_phong_lines(const BenchPhongLinesOptions& options);

} // namespace nusselt::app
