#include "bench_samplers.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "apps/common/print_message.h"
#include "lab/timing/sampler_timing.h"
#include "lab/timing/scalar_programs.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <utility>

namespace nusselt::app {

namespace {

using Number = std::optional<double>;

std::string text_of(const Number& a, int decimals) { return a ? fmt::format("{:.{}f}", *a, decimals) : "-"; }

/// Empty without the first one.
std::string pair(const Number& a, const Number& b, int decimals) {
    return a ? text_of(a, decimals) + " / " + text_of(b, decimals) : "";
}

void print_table(const std::vector<lab::SamplerTiming>& rows) {
    fmt::print(
        "One thread; ns, medians with the baseline subtracted; packs: per lane. prepare: per light, with\n"
        "clipping. sample: with density and hit point. without: without them. world: to shading space and\n"
        "prepare. once: prepare and one sample. x: over the published formulas in the same code, prepare /\n"
        "sample, world and once. grows: x over that of 4 vertices. instructions: prepare / sample, and "
        "x.\n\n");
    constexpr const char* kFormat =
        "{:<37}{:<34}{:<28}{:>9}{:>9}{:>9}{:>9}{:>9}{:>15}{:>7}{:>7}{:>15}{:>15}{:>15}\n";
    fmt::print(kFormat, "technique", "lights", "code", "prepare", "sample", "without", "world", "once", "x",
               "world", "once", "grows", "instructions", "x");
    for (const auto& row : rows)
        fmt::print(kFormat, row.technique, row.configuration, row.code, text_of(row.prepare_ns, 2),
                   text_of(row.sample_ns, 2), text_of(row.direction_ns, 2), text_of(row.world_ns, 2),
                   text_of(row.once_ns, 2), pair(row.prepare_ratio, row.sample_ratio, 2),
                   text_of(row.world_ratio, 2), text_of(row.once_ratio, 2),
                   pair(row.prepare_growth, row.sample_growth, 2),
                   pair(row.prepare_instructions, row.sample_instructions, 0),
                   pair(row.prepare_instructions_ratio, row.sample_instructions_ratio, 2));
}

lab::ResultTable table_of(const std::vector<lab::SamplerTiming>& rows) {
    lab::ResultTable table = {"samplers", {{"technique"}, {"lights"}, {"code"}, {"isa"}}};
    struct NumberColumn {
        lab::Column column;
        Number lab::SamplerTiming::*member;
    };
    using Row = lab::SamplerTiming;
    const NumberColumn columns[] = {{{"prepare_ns", "ns"}, &Row::prepare_ns},
                                    {{"sample_ns", "ns"}, &Row::sample_ns},
                                    {{"prepare_spread_ns", "ns"}, &Row::prepare_spread_ns},
                                    {{"sample_spread_ns", "ns"}, &Row::sample_spread_ns},
                                    {{"direction_ns", "ns"}, &Row::direction_ns},
                                    {{"transform_ns", "ns"}, &Row::transform_ns},
                                    {{"world_ns", "ns"}, &Row::world_ns},
                                    {{"once_ns", "ns"}, &Row::once_ns},
                                    {{"prepare_instructions"}, &Row::prepare_instructions},
                                    {{"sample_instructions"}, &Row::sample_instructions},
                                    {{"prepare_ratio"}, &Row::prepare_ratio},
                                    {{"sample_ratio"}, &Row::sample_ratio},
                                    {{"world_ratio"}, &Row::world_ratio},
                                    {{"once_ratio"}, &Row::once_ratio},
                                    {{"prepare_instructions_ratio"}, &Row::prepare_instructions_ratio},
                                    {{"sample_instructions_ratio"}, &Row::sample_instructions_ratio},
                                    {{"prepare_growth"}, &Row::prepare_growth},
                                    {{"sample_growth"}, &Row::sample_growth}};
    for (const NumberColumn& c : columns) table.columns.push_back(c.column);
    for (const auto& row : rows) {
        std::vector<lab::Cell> cells = {row.technique, row.configuration, row.code, row.isa};
        for (const NumberColumn& c : columns) cells.push_back(lab::cell_of(row.*c.member));
        table.rows.push_back(std::move(cells));
    }
    return table;
}

/// Adds the rows of the programs that the build made for other compilers.
void add_compilers(int repetitions, std::vector<lab::SamplerTiming>& rows) {
    for (const lab::ScalarProgram& program : lab::scalar_programs()) {
        const auto path = lab::folder_of_scalar_programs() / program.file;
        if (!std::filesystem::exists(path)) {
            print_message("warning: no times for {}: the build has not made {}\n", program.code,
                          path.string());
            continue;
        }
        const auto more = lab::time_scalar_program(path, program.code, repetitions);
        rows.insert(rows.end(), more.begin(), more.end());
    }
}

} // namespace

int run_bench_samplers(const BenchSamplersOptions& options) {
    check_json_option(options.json);
    auto rows = lab::time_samplers({options.repetitions, options.isa});
    const std::string isa = rows.front().isa;
    if (options.compilers) add_compilers(options.repetitions, rows);
    lab::add_ratios(rows);
    const lab::Results results = {
        "samplers", {{"repetitions", options.repetitions}, {"isa", isa}}, {table_of(rows)}};
    write_results(options.json, results, [&] { print_table(rows); });
    return 0;
}

void setup_bench_samplers(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchSamplersOptions>();
    CLI::App* command = bench.add_subcommand("samplers", "Cost of preparing and of sampling each technique.");
    add_repetitions_option(*command, options->repetitions);
    add_isa_option(*command, options->isa);
    command->add_flag(
        "--compilers", options->compilers,
        "Also scalar code as g++ -O2, g++ -O3 -march=native and clang 19 make it, with instruction counts. "
        "Takes some minutes more.");
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_samplers(*options); });
}

} // namespace nusselt::app
