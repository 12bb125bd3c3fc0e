#pragma once
/// `nusselt bench samplers`: cost of preparing and of sampling each technique.

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace nusselt::app {

struct BenchSamplersOptions {
    int repetitions = 31;
    std::string isa = "auto";
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_samplers() in exit_code, which must live
/// until the command line was parsed.
void setup_bench_samplers(CLI::App& bench, int& exit_code);

/// Runs the timings and prints or writes them.
/// \returns 0; errors are thrown
int run_bench_samplers(const BenchSamplersOptions& options);

} // namespace nusselt::app
