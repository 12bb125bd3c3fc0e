#include "bench_instructions.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "base/isa.h"
#include "lab/timing/sampler_instructions.h"
#include "lab/timing/sampler_timing.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>
#include <stdexcept>

namespace nusselt::app {

void setup_bench_instructions(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchInstructionsOptions>();
    CLI::App* command = bench.add_subcommand(
        "instructions",
        "Instructions that each technique executes per light and per sample, without those of a "
        "baseline; those of packs count once for all lanes. Takes some seconds.");
    add_isa_option(*command, options->isa);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_instructions(*options); });
}

int run_bench_instructions(const BenchInstructionsOptions& options) {
    check_json_option(options.json);
    const base::Isa isa = base::choose_isa(options.isa);
    const auto table = lab::count_sampler_instructions(isa, lab::timed_techniques_for(isa));
    if (table.rows.empty()) throw std::runtime_error("instructions cannot be counted on this machine");
    write_results(options.json, lab::results_of(table), [&] {
        constexpr const char* kFormat = "{:<37}{:<34}{:<26}{:>9}{:>9}\n";
        fmt::print("{}, {}\n", table.isa, table.compiler);
        fmt::print(kFormat, "technique", "lights", "code", "prepare", "sample");
        for (const auto& row : table.rows)
            fmt::print(kFormat, row.technique, row.configuration, row.code,
                       fmt::format("{:.0f}", row.prepare), fmt::format("{:.0f}", row.sample));
    });
    return 0;
}

} // namespace nusselt::app
