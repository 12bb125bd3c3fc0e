#include "bench_samplers.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "image/io.h"
#include "lab/timing/sampler_timing.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace nusselt::app {

namespace {

void print_table(const std::vector<lab::SamplerTiming>& rows) {
    fmt::print("One thread; ns, medians with the baseline subtracted. Lanes: 1 is scalar code, else lanes of "
               "a register or of\n"
               "two in flight; times are per lane. prepare: per light, with clipping. sample: a light per "
               "lane; of one: one light\n"
               "in all lanes. x plain: prepare and sample over the plain transcription of the published "
               "formulas as scalar code.\n\n");
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

std::string to_json(const std::vector<lab::SamplerTiming>& rows) {
    nlohmann::json json = nlohmann::json::array();
    for (const auto& row : rows)
        json.push_back({{"technique", row.technique},
                        {"lights", row.configuration},
                        {"isa", row.isa},
                        {"lanes", row.lanes},
                        {"prepare_ns", row.prepare_ns},
                        {"sample_ns", row.sample_ns},
                        {"sample_one_ns", row.sample_one_ns},
                        {"prepare_ratio", row.prepare_ratio},
                        {"sample_ratio", row.sample_ratio},
                        {"spread", row.spread}});
    return json.dump(2) + "\n";
}

} // namespace

int run_bench_samplers(const BenchSamplersOptions& options) {
    if (options.json && *options.json != "-") image::check_writable(*options.json);
    const auto rows = lab::time_samplers({options.repetitions, options.isa});
    write_results(options.json, to_json(rows), [&] { print_table(rows); });
    return 0;
}

void setup_bench_samplers(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchSamplersOptions>();
    CLI::App* command = bench.add_subcommand("samplers", "Cost of preparing and of sampling each technique");
    add_repetitions_option(*command, options->repetitions);
    add_isa_option(*command, options->isa);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_samplers(*options); });
}

} // namespace nusselt::app
