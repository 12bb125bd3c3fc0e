#include "fuzz.h"
#include "apps/common/progress.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"

#include "base/isa.h"
#include "base/stopwatch.h"
#include "lab/fuzzing/fuzz.h"
#include "render_cpu/renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

int run_fuzz(const FuzzOptions& options) {
    const std::string isa(name_of(base::choose_isa(options.isa)));
    lab::FuzzSettings settings{options.techniques, options.seed, options.first, options.count,
                               options.threads.value_or(render_cpu::default_thread_count())};
    const base::Stopwatch stopwatch;
    Progress progress;
    const auto rows =
        lab::fuzz_library(options.scalar, isa, settings, [&](double fraction) { progress.update(fraction); });
    progress.finish();
    const double seconds = stopwatch.seconds();

    std::uint64_t violations = 0;
    fmt::print("{:<34}{:<16}{:>12}{:>12}\n", "technique", "lights", "violations", "ns");
    for (const auto& row : rows) {
        violations += row.violations;
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
    if (violations > 0)
        fmt::print(
            "\nTo run one of these alone: nusselt-lab fuzz --scalar {} --isa {} --seed {} --technique NAME "
            "--first INDEX --count 1\n",
            options.scalar, isa, options.seed);
    return violations > 0 ? 1 : 0;
}

void setup_fuzz(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<FuzzOptions>();
    CLI::App* command = bench.add_subcommand(
        "fuzz",
        "Run techniques on lights that break samplers, and check that results are finite, on the light and\n"
        "consistent. Exits with 1 if one is not. A configuration depends on its index and the seed only");
    command->add_option("--count", options->count, "Configurations per technique")
        ->check(whole_number(1, 1'000'000'000'000))
        ->capture_default_str();
    command->add_option("--first", options->first, "Index of the first configuration")
        ->check(whole_number(0, UINT64_MAX))
        ->capture_default_str();
    command->add_option("--seed", options->seed, "Seed of the configurations")
        ->check(whole_number(0, UINT64_MAX))
        ->capture_default_str();
    command
        ->add_option("--technique", options->techniques,
                     "Class name of a technique; may be repeated. Default: all")
        ->check(CLI::IsMember(lab::fuzz_technique_names()));
    command->add_option("--scalar", options->scalar, "Number type: float, double or longdouble")
        ->check(CLI::IsMember({"float", "double", "longdouble"}))
        ->capture_default_str();
    add_machine_options(*command, options->threads, options->isa);
    command->callback([options, &exit_code] { exit_code = run_fuzz(*options); });
}

} // namespace nusselt::app
