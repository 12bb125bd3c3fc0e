#pragma once
/// `nusselt-lab bench accuracy`

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchAccuracyOptions {
    int count =
        5000; ///< of docs/data/accuracy.json: the test that compares with it takes a quarter of a minute
    std::optional<std::string> isa;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_accuracy() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_accuracy(CLI::App& bench, int& exit_code);

/// Measures the accuracy of each technique and prints or writes the tables.
int run_bench_accuracy(const BenchAccuracyOptions& options);

} // namespace nusselt::app
