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
        "tubes",
        "Noise and cost of sampling cylinders of finite radius, next to rejection sampling (Gamito 2016).\n"
        "Relative standard deviations of the weights of single samples without shadows. Hits and the last\n"
        "deviation are those of rejection sampling on a Lambertian surface, to be compared with projected\n"
        "solid angle; x time: preparing and one sample with the latter over the same with rejection.");
    add_repetitions_option(*command, options->repetitions);
    command->callback([options, &exit_code] { exit_code = run_bench_tubes(*options); });
}

int run_bench_tubes(const BenchTubesOptions& options) {
    fmt::print("{:<34}{:>12}{:>12}{:>12}{:>10}{:>12}{:>8}\n", "light", "solid angle", "projected", "lobe",
               "hits", "rejection", "x time");
    for (const proof::TubeLight& light : proof::tube_lights()) {
        const lab::TubeNoise noise = lab::measure_tube_noise(light);
        fmt::print("{:<34}{:>12.4f}{:>12.4f}{:>12.4f}{:>8.1f} %{:>12.4f}{:>8.2f}\n", light.name,
                   noise.solid_angle, noise.projected_solid_angle, noise.lobe, 100 * noise.rejection_hits,
                   noise.rejection, lab::measure_tube_time_ratio(light, options.repetitions));
    }
    return 0;
}

} // namespace nusselt::app
