#include "bench_shadows.h"
#include "apps/common/progress.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "base/isa.h"
#include "base/stopwatch.h"
#include "lab/fuzzing/shadow_fuzz.h"
#include "render_cpu/renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

namespace {

void print_table(const std::vector<lab::ShadowFuzzRow>& rows, const BenchShadowsOptions& options,
                 const std::string& isa, double seconds) {
    bool is_broken = false;
    fmt::print("{:<26}{:>14}{:>16}{:>12}\n", "cases", "segments", "triangles", "violations");
    for (const auto& row : rows) {
        is_broken = is_broken || row.violations > 0;
        fmt::print("{:<26}{:>14}{:>16}{:>12}\n", row.kind, options.count * proof::kLinesPerCase,
                   row.triangles, row.violations);
    }
    fmt::print("\n{}, seed {}: {} cases of each kind from index {}, each with denormal numbers and with\n"
               "denormals flushed to zero, {:.1f} s\n",
               isa, options.seed, options.count, options.first, seconds);
    for (const auto& row : rows)
        for (const lab::ShadowReport& report : row.reports)
            fmt::print("\n{}, index {}: {}\n", row.kind, report.index, report.text);
    if (is_broken)
        fmt::print("\nTo run one of them alone: nusselt-lab bench shadows --isa {} --seed {} --first INDEX "
                   "--count 1\n",
                   isa, options.seed);
}

} // namespace

int run_bench_shadows(const BenchShadowsOptions& options) {
    check_json_option(options.json);
    const std::string isa(name_of(base::choose_isa(options.isa)));
    const lab::ShadowFuzzSettings settings{options.seed, options.first, options.count,
                                           render_cpu::checked_thread_count(options.threads)};
    const base::Stopwatch stopwatch;
    Progress progress;
    const auto rows = lab::fuzz_shadows(lab::choose_shadow_checks(isa), settings,
                                        [&](double fraction) { progress.update(fraction); });
    progress.finish();
    const double seconds = stopwatch.seconds();

    std::uint64_t violations = 0;
    lab::ResultTable table = {"cases", {{"cases"}, {"segments"}, {"triangles"}, {"violations"}}};
    for (const auto& row : rows) {
        violations += row.violations;
        table.rows.push_back({row.kind, options.count * proof::kLinesPerCase, row.triangles, row.violations});
    }
    const lab::Results results = {"shadows",
                                  {{"isa", isa},
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

void setup_bench_shadows(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchShadowsOptions>();
    CLI::App* command = bench.add_subcommand(
        "shadows",
        "Look for lines that see through closed meshes, and for lights, points and occluders that break the "
        "visible "
        "parts of lines. Exits with 1 if any is found. Cases depend only on their index and the seed.");
    command->add_option("--count", options->count, "Cases of each kind, with 16 segments each")
        ->transform(to_whole_number(1, kMostCases));
    command->add_option("--first", options->first, "Index of the first case")
        ->transform(to_whole_number(0, UINT64_MAX - kMostCases));
    command->add_option("--seed", options->seed, "Seed of the cases")
        ->transform(to_whole_number(0, UINT64_MAX));
    add_machine_options(*command, options->threads, options->isa);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_shadows(*options); });
}

} // namespace nusselt::app
