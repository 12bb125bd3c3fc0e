#include "bench_tubes.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "lab/figures/tube_noise.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

void setup_bench_tubes(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchTubesOptions>();
    CLI::App* command = bench.add_subcommand(
        "tubes", "Noise and cost of sampling cylinders of finite radius, beside rejection sampling (Gamito "
                 "2016). Prints "
                 "relative standard deviations of the weights of single samples without shadows. hits and "
                 "rejection are the hits "
                 "and the deviation of rejection sampling on a Lambertian surface, to be compared with the "
                 "projected solid "
                 "angle; x time: preparing and one sample of the latter over the same of rejection.");
    add_repetitions_option(*command, options->repetitions);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_tubes(*options); });
}

int run_bench_tubes(const BenchTubesOptions& options) {
    check_json_option(options.json);
    lab::ResultTable table = {"tubes",
                              {{"light"},
                               {"solid_angle"},
                               {"projected_solid_angle"},
                               {"lobe"},
                               {"rejection_hits"},
                               {"rejection"},
                               {"time_ratio"}}};
    std::string text = fmt::format("{:<34}{:>12}{:>12}{:>12}{:>10}{:>12}{:>8}\n", "light", "solid angle",
                                   "projected", "lobe", "hits", "rejection", "x time");
    for (const proof::TubeLight& light : proof::tube_lights()) {
        const lab::TubeNoise noise = lab::measure_tube_noise(light);
        const double time_ratio = lab::measure_tube_time_ratio(light, options.repetitions);
        text += fmt::format("{:<34}{:>12.4f}{:>12.4f}{:>12.4f}{:>8.1f} %{:>12.4f}{:>8.2f}\n", light.name,
                            noise.solid_angle, noise.projected_solid_angle, noise.lobe,
                            100 * noise.rejection_hits, noise.rejection, time_ratio);
        table.rows.push_back({std::string(light.name), noise.solid_angle, noise.projected_solid_angle,
                              noise.lobe, noise.rejection_hits, noise.rejection, time_ratio});
    }
    const lab::Results results = {"tubes", {{"repetitions", options.repetitions}}, {std::move(table)}};
    write_results(options.json, results, [&] { fmt::print("{}", text); });
    return 0;
}

} // namespace nusselt::app
