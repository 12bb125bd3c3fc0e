#include "bench_gpu_samplers.h"
#include "apps/nusselt-lab/bench/bench_device.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "lab/timing/gpu_samplers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace nusselt::app {

namespace {

std::string text_of(const std::optional<double>& ratio) {
    return ratio ? fmt::format("{:.2f}", *ratio) : "-";
}

nlohmann::json json_of(const std::optional<double>& ratio) {
    return ratio ? nlohmann::json(*ratio) : nlohmann::json(nullptr);
}

void print_table(const lab::GpuSamplerTable& table) {
    print_device(table.device, table.clock, table.fused_fma ? "; fma rounds once" : "; fma rounds twice",
                 text_of_threads(table.llvmpipe_threads));
    fmt::print("ns, medians with the baseline subtracted. light: per light that is prepared and sampled "
               "once, 128 per\n"
               "thread. sample: per sample of a light, prepared once for 128. x Peters: both over the "
               "published formulas.\n\n");
    fmt::print("{:<34}{:<34}{:>10}{:>8}{:>10}{:>8}{:>15}\n", "technique", "lights", "light", "spread",
               "sample", "spread", "x Peters");
    for (const auto& row : table.rows) {
        fmt::print("{:<34}{:<34}{:>10.4g}{:>7.0f}%{:>10.4g}{:>7.0f}%{:>15}\n", row.technique,
                   row.configuration, row.light_ns, 100 * row.light_spread, row.sample_ns,
                   100 * row.sample_spread, text_of(row.light_ratio) + " / " + text_of(row.sample_ratio));
    }
}

std::string to_json(const lab::GpuSamplerTable& table) {
    nlohmann::json rows = nlohmann::json::array();
    for (const auto& row : table.rows)
        rows.push_back({{"technique", row.technique},
                        {"lights", row.configuration},
                        {"light_ns", row.light_ns},
                        {"sample_ns", row.sample_ns},
                        {"light_spread", row.light_spread},
                        {"sample_spread", row.sample_spread},
                        {"light_ratio", json_of(row.light_ratio)},
                        {"sample_ratio", json_of(row.sample_ratio)}});
    const nlohmann::json json = {{"device", table.device.name},
                                 {"kind", table.device.kind},
                                 {"driver", table.device.driver},
                                 {"vulkan", table.device.api_version},
                                 {"clock", text_of_clock(table.clock)},
                                 {"fused_fma", table.fused_fma},
                                 {"threads", text_of_threads(table.llvmpipe_threads)},
                                 {"rows", rows}};
    return json.dump(2) + "\n";
}

} // namespace

int run_bench_gpu_samplers(const BenchGpuSamplersOptions& options) {
    const auto table = lab::time_gpu_samplers({options.repetitions, options.device});
    write_results(options.json, to_json(table), [&] { print_table(table); });
    return 0;
}

void setup_bench_gpu_samplers(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchGpuSamplersOptions>();
    CLI::App* command = bench.add_subcommand("gpu-samplers", "Cost of each technique on a GPU");
    add_repetitions_option(*command, options->repetitions);
    add_device_option(*command, options->device);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_gpu_samplers(*options); });
}

} // namespace nusselt::app
