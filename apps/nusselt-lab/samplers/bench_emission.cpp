#include "bench_emission.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "lab/emission/emission_timing.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>
#include <vector>

namespace nusselt::app {

void setup_bench_emission(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchEmissionOptions>();
    CLI::App* command = bench.add_subcommand(
        "emission",
        "Time to sample lights whose radiance varies: polygons, lines and tubes with textures, "
        "environment maps and portals, and its ratio to projected solid angle sampling of a uniform "
        "rectangle, line or tube, packs to packs. Per shading point, float, one thread.");
    add_repetitions_option(*command, options->repetitions);
    add_isa_option(*command, options->isa);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_emission(*options); });
}

int run_bench_emission(const BenchEmissionOptions& options) {
    check_json_option(options.json);
    const base::Isa isa = base::choose_isa(options.isa);
    const std::vector<lab::EmissionCost> costs = lab::time_emission(options.repetitions, isa);
    std::string text =
        fmt::format("{}; ns, and ratios to projected solid angle sampling of the same "
                    "light\n{:<32}{:>16}{:>24}{:>20}{:>16}\n",
                    name_of(isa), "", "prepare", "prepare and one sample", "one more sample", "density");
    lab::ResultTable table = {"emission",
                              {{"technique"},
                               {"uniform"},
                               {"prepare_ns", "ns"},
                               {"prepare_ratio"},
                               {"first_sample_ns", "ns"},
                               {"first_sample_ratio"},
                               {"next_sample_ns", "ns"},
                               {"next_sample_ratio"},
                               {"density_ns", "ns"}}};
    for (const lab::EmissionCost& cost : costs) {
        const lab::EmissionCost& uniform = costs[cost.uniform];
        const double prepare = cost.prepare_ns / uniform.prepare_ns;
        const double first = cost.first_sample_ns / uniform.first_sample_ns;
        const double next = cost.next_sample_ns / uniform.next_sample_ns;
        text += fmt::format("{:<32}{:>9.0f}{:>7.1f}{:>17.0f}{:>7.1f}{:>13.0f}{:>7.1f}{:>16.0f}\n",
                            cost.technique, cost.prepare_ns, prepare, cost.first_sample_ns, first,
                            cost.next_sample_ns, next, cost.density_ns);
        table.rows.push_back({cost.technique, uniform.technique, cost.prepare_ns, prepare,
                              cost.first_sample_ns, first, cost.next_sample_ns, next, cost.density_ns});
    }
    const lab::Results results = {"emission",
                                  {{"repetitions", options.repetitions}, {"isa", std::string(name_of(isa))}},
                                  {std::move(table)}};
    write_results(options.json, results, [&] { fmt::print("{}", text); });
    return 0;
}

} // namespace nusselt::app
