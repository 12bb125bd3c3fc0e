#include "fuzz.h"
#include "apps/common/progress.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "base/isa.h"
#include "base/stopwatch.h"
#include "lab/fuzzing/fuzz.h"
#include "render_cpu/renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

namespace {

void print_table(const std::vector<lab::FuzzRow>& rows, const FuzzOptions& options, const std::string& isa,
                 double seconds) {
    bool is_broken = false;
    fmt::print("{:<34}{:<16}{:>12}{:>12}\n", "technique", "lights", "violations", "ns");
    for (const auto& row : rows) {
        is_broken = is_broken || row.violations > 0;
        fmt::print("{:<34}{:<16}{:>12}{:>12.0f}\n", row.technique, name_of(row.light), row.violations,
                   row.nanoseconds);
    }
    fmt::print(
        "\n{}, {}, seed {}: {} configurations from index {} per technique, each with denormal numbers and\n"
        "with denormals flushed to zero, {:.1f} s, {:.3g} million checks per second\n",
        options.scalar, isa, options.seed, options.count, options.first, seconds,
        2e-6 * static_cast<double>(options.count) * static_cast<double>(rows.size()) / seconds);
    for (const auto& row : rows)
        for (const lab::FuzzReport& report : row.reports)
            fmt::print("\n{}, {}, index {}{}: {}\n", row.technique, name_of(row.light), report.index,
                       report.flushed ? ", denormals flushed" : "", report.text);
    if (is_broken)
        fmt::print(
            "\nTo run one of them alone: nusselt-lab fuzz --scalar {} --isa {} --seed {} --technique NAME "
            "--first INDEX --count 1\n",
            options.scalar, isa, options.seed);
}

} // namespace

int run_fuzz(const FuzzOptions& options) {
    check_json_option(options.json);
    const std::string isa(name_of(base::choose_isa(options.isa)));
    lab::FuzzSettings settings{options.techniques, options.seed, options.first, options.count,
                               render_cpu::checked_thread_count(options.threads)};
    const base::Stopwatch stopwatch;
    Progress progress;
    const auto rows =
        lab::fuzz_library(options.scalar, isa, settings, [&](double fraction) { progress.update(fraction); });
    progress.finish();
    const double seconds = stopwatch.seconds();

    std::uint64_t violations = 0;
    lab::ResultTable table = {"techniques", {{"technique"}, {"lights"}, {"violations"}, {"time", "ns"}}};
    for (const auto& row : rows) {
        violations += row.violations;
        table.rows.push_back({row.technique, name_of(row.light), row.violations, row.nanoseconds});
    }
    const lab::Results results = {"fuzz",
                                  {{"scalar", options.scalar},
                                   {"isa", isa},
                                   {"seed", options.seed},
                                   {"first", options.first},
                                   {"count", options.count},
                                   {"seconds", seconds}},
                                  {std::move(table)}};
    write_results(options.json, results, [&] { print_table(rows, options, isa, seconds); });
    return violations > 0 ? 1 : 0;
}

/// In one run; indices stay within 64 bits.
constexpr std::uint64_t kMostCases = 1'000'000'000'000;

void setup_fuzz(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<FuzzOptions>();
    CLI::App* command = bench.add_subcommand(
        "fuzz", "Run techniques on lights that break samplers, and check that results are finite, on the "
                "light and consistent. "
                "Exits with 1 if any check fails. Configurations depend only on their index and the seed.");
    command->add_option("--count", options->count, "Configurations per technique")
        ->transform(to_whole_number(1, kMostCases));
    command
        ->add_option("--first", options->first, "Index of the first configuration, to run some of them again")
        ->transform(to_whole_number(0, UINT64_MAX - kMostCases));
    command->add_option("--seed", options->seed, "Seed of the configurations")
        ->transform(to_whole_number(0, UINT64_MAX));
    command->add_option("--technique", options->techniques, "Class name of a technique. May be repeated")
        ->transform(to_one_of(lab::fuzz_technique_names()))
        ->default_str("all");
    command->add_option("--scalar", options->scalar, "Number type")
        ->transform(to_one_of({"float", "double", "longdouble"}));
    add_machine_options(*command, options->threads, options->isa);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_fuzz(*options); });
}

} // namespace nusselt::app
