#include "commands.h"

#include "experiments/gpu_samplers.h"
#include "image/atomic_file.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <memory>

namespace nusselt::app {

namespace {

/// What a software device runs on; empty for others.
std::string threads_of(const experiments::GpuSamplerTable& table) {
    if (table.device.kind != "CPU") return "";
    return table.software_threads.empty() ? "a thread per core (LP_NUM_THREADS=1 times one)"
                                          : "LP_NUM_THREADS=" + table.software_threads;
}

std::string clock_of(const experiments::GpuSamplerTable& table) {
    return table.clock == gpu::Clock::timestamps ? "timestamps of the device" : "wall clock";
}

void print_table(const experiments::GpuSamplerTable& table) {
    fmt::print("{} ({}), {}, Vulkan {}\n", table.device.name, table.device.kind, table.device.driver,
               table.device.api_version);
    fmt::print("{}; fma rounds {}", clock_of(table), table.fused_fma ? "once" : "twice");
    if (const std::string threads = threads_of(table); !threads.empty()) fmt::print("; {}", threads);
    fmt::print("\nns, medians with the baseline subtracted. light: per light that is prepared and sampled "
               "once, 128 per\n"
               "thread. sample: per sample of a light, prepared once for 128. x Peters: both over the "
               "published formulas.\n\n");
    fmt::print("{:<34}{:<34}{:>10}{:>10}{:>8}{:>15}\n", "technique", "lights", "light", "sample", "spread",
               "x Peters");
    for (const auto& row : table.rows) {
        const std::string ratio =
            row.light_ratio > 0 ? fmt::format("{:.2f} / {:.2f}", row.light_ratio, row.sample_ratio) : "";
        fmt::print("{:<34}{:<34}{:>10.4g}{:>10.4g}{:>7.0f}%{:>15}\n", row.technique, row.configuration,
                   row.light_ns, row.sample_ns, 100 * row.spread, ratio);
    }
}

std::string to_json(const experiments::GpuSamplerTable& table) {
    nlohmann::json rows = nlohmann::json::array();
    for (const auto& row : table.rows)
        rows.push_back({{"technique", row.technique},
                        {"lights", row.configuration},
                        {"light_ns", row.light_ns},
                        {"sample_ns", row.sample_ns},
                        {"light_ratio", row.light_ratio},
                        {"sample_ratio", row.sample_ratio},
                        {"spread", row.spread}});
    const nlohmann::json json = {{"device", table.device.name},   {"kind", table.device.kind},
                                 {"driver", table.device.driver}, {"vulkan", table.device.api_version},
                                 {"clock", clock_of(table)},      {"fused_fma", table.fused_fma},
                                 {"threads", threads_of(table)},  {"rows", rows}};
    return json.dump(2) + "\n";
}

} // namespace

int run_bench_gpu_samplers(const BenchGpuSamplersOptions& options) {
    const auto table = experiments::time_gpu_samplers({options.repetitions, options.device});
    if (options.json && *options.json == "-") {
        fmt::print("{}", to_json(table));
        return 0;
    }
    print_table(table);
    if (options.json)
        image::write_atomically(*options.json, [&](std::ofstream& file) { file << to_json(table); });
    return 0;
}

void setup_bench_gpu_samplers(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchGpuSamplersOptions>();
    CLI::App* command = bench.add_subcommand("gpu-samplers", "Cost of each technique on a GPU");
    command
        ->add_option("--repetitions", options->repetitions,
                     "Interleaved repetitions, of which the median counts")
        ->check(CLI::Range(1, 10001))
        ->capture_default_str();
    command->add_option("--device", options->device,
                        "Vulkan device: its index, or part of its name. Default: the environment variable\n"
                        "NUSSELT_DEVICE, else a discrete GPU before others");
    command->add_option("--json", options->json,
                        "Write the table as JSON to this file; - for the standard output");
    command->callback([options, &exit_code] { exit_code = run_bench_gpu_samplers(*options); });
}

} // namespace nusselt::app
