#include "bench_samplers.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "lab/timing/sampler_timing.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

namespace {

void print_table(const std::vector<lab::SamplerTiming>& rows) {
    fmt::print("One thread; ns, medians with the baseline subtracted. lanes: 1 for scalar code, else the\n"
               "lanes of one register or of two in flight; times are per lane. prepare: per light, with\n"
               "clipping. sample: a light per lane; of one: one light in all lanes. x plain: prepare and\n"
               "sample over a plain transcription of the published formulas as scalar code.\n\n");
    fmt::print("{:<34}{:<34}{:>8}{:>6}{:>9}{:>9}{:>9}{:>8}{:>15}\n", "technique", "lights", "isa", "lanes",
               "prepare", "sample", "of one", "spread", "x plain");
    for (const auto& row : rows) {
        const std::string ratio =
            row.prepare_ratio > 0 ? fmt::format("{:.2f} / {:.2f}", row.prepare_ratio, row.sample_ratio) : "";
        fmt::print("{:<34}{:<34}{:>8}{:>6}{:>9.2f}{:>9.2f}{:>9.2f}{:>7.0f}%{:>15}\n", row.technique,
                   row.configuration, row.isa, row.lanes, row.prepare_ns, row.sample_ns, row.sample_one_ns,
                   100 * row.spread, ratio);
    }
}

/// 0 stands for no ratio.
lab::Cell ratio_cell(double ratio) { return ratio > 0 ? lab::Cell(ratio) : lab::Cell(nullptr); }

lab::ResultTable table_of(const std::vector<lab::SamplerTiming>& rows) {
    lab::ResultTable table = {"samplers",
                              {{"technique"},
                               {"lights"},
                               {"isa"},
                               {"lanes"},
                               {"code"},
                               {"prepare_ns", "ns"},
                               {"sample_ns", "ns"},
                               {"sample_one_ns", "ns"},
                               {"prepare_ratio"},
                               {"sample_ratio"},
                               {"spread"}}};
    for (const auto& row : rows)
        table.rows.push_back({row.technique, row.configuration, row.isa, row.lanes,
                              row.lanes == 1 ? "scalar" : fmt::format("packs of {}, per lane", row.lanes),
                              row.prepare_ns, row.sample_ns, row.sample_one_ns, ratio_cell(row.prepare_ratio),
                              ratio_cell(row.sample_ratio), row.spread});
    return table;
}

} // namespace

int run_bench_samplers(const BenchSamplersOptions& options) {
    check_json_option(options.json);
    const auto rows = lab::time_samplers({options.repetitions, options.isa});
    const lab::Results results = {
        "samplers", {{"repetitions", options.repetitions}, {"isa", rows.front().isa}}, {table_of(rows)}};
    write_results(options.json, results, [&] { print_table(rows); });
    return 0;
}

void setup_bench_samplers(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchSamplersOptions>();
    CLI::App* command = bench.add_subcommand("samplers", "Cost of preparing and of sampling each technique.");
    add_repetitions_option(*command, options->repetitions);
    add_isa_option(*command, options->isa);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_samplers(*options); });
}

} // namespace nusselt::app
