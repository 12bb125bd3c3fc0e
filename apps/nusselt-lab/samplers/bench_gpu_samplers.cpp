#include "bench_gpu_samplers.h"
#include "apps/nusselt-lab/bench/bench_device.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "lab/timing/gpu_samplers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

namespace {

std::string text_of(const std::optional<double>& ratio) {
    return ratio ? fmt::format("{:.2f}", *ratio) : "-";
}

void print_table(const lab::GpuSamplerTable& table) {
    print_device(table.device, table.clock, table.fused_fma ? "; fma rounds once" : "; fma rounds twice",
                 text_of_threads(table.llvmpipe_threads));
    fmt::print(
        "ns, medians with the baseline subtracted. light: per light, prepared and sampled once, 128\n"
        "lights per thread. sample: per sample of a light, prepared once for 128. x Peters: both over\n"
        "the published formulas. alone: samples without density and hit point.\n\n");
    fmt::print("{:<34}{:<34}{:<6}{:>10}{:>8}{:>10}{:>8}{:>15}\n", "technique", "lights", "", "light",
               "spread", "sample", "spread", "x Peters");
    for (const auto& row : table.rows) {
        fmt::print("{:<34}{:<34}{:<6}{:>10.4g}{:>7.0f}%{:>10.4g}{:>7.0f}%{:>15}\n", row.technique,
                   row.configuration, row.directions ? "alone" : "", row.light_ns, 100 * row.light_spread,
                   row.sample_ns, 100 * row.sample_spread,
                   text_of(row.light_ratio) + " / " + text_of(row.sample_ratio));
    }
}

lab::Results results_of(const lab::GpuSamplerTable& table) {
    lab::ResultTable rows = {"samplers",
                             {{"technique"},
                              {"lights"},
                              {"samples"},
                              {"light_ns", "ns"},
                              {"sample_ns", "ns"},
                              {"light_spread"},
                              {"sample_spread"},
                              {"light_ratio"},
                              {"sample_ratio"}}};
    for (const auto& row : table.rows)
        rows.rows.push_back({row.technique, row.configuration,
                             row.directions ? "directions alone" : "with density and point", row.light_ns,
                             row.sample_ns, row.light_spread, row.sample_spread,
                             lab::cell_of(row.light_ratio), lab::cell_of(row.sample_ratio)});
    lab::Results results = {"gpu-samplers",
                            device_settings(table.device, table.clock, table.llvmpipe_threads),
                            {std::move(rows)}};
    results.settings.emplace_back("fused_fma", table.fused_fma);
    return results;
}

} // namespace

int run_bench_gpu_samplers(const BenchGpuSamplersOptions& options) {
    check_json_option(options.json);
    const auto table = lab::time_gpu_samplers({options.repetitions, options.device});
    write_results(options.json, results_of(table), [&] { print_table(table); });
    return 0;
}

void setup_bench_gpu_samplers(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchGpuSamplersOptions>();
    CLI::App* command = bench.add_subcommand("gpu-samplers", "Cost of each technique on a GPU.");
    add_repetitions_option(*command, options->repetitions);
    add_device_option(*command, options->device);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_gpu_samplers(*options); });
}

} // namespace nusselt::app
