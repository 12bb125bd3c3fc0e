#include "bench_strategies.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "bench_frames.h"

#include "render_cpu/renderer.h"
#include "scene/import/importers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <memory>

namespace nusselt::app {

namespace {

using render::Strategies;

/// Times of one choice of strategies, a number for each repetition [s].
struct StrategiesRow {
    std::string name;
    render::RenderSettings settings;
    std::uint64_t shadow_rays = 0;
    std::vector<double> render_seconds = {};  ///< of the whole render phase
    std::vector<double> shading_seconds = {}; ///< sum over threads, without tracing of rays
};

std::vector<StrategiesRow> make_rows(int samples) {
    render::RenderSettings one;
    one.samples = samples;
    one.camera_rays = 1;
    one.strategies = Strategies::diffuse;
    render::RenderSettings two = one;
    two.samples = 2 * samples;
    render::RenderSettings both = one;
    both.strategies = Strategies::diffuse_ltc;
    return {{"diffuse", one}, {"diffuse, two samples", two}, {"diffuse+ltc", both}};
}

/// Interleaves the runs, so that other load on the machine affects all rows alike.
void measure(std::vector<StrategiesRow>& rows, const render_cpu::Renderer& renderer, base::Isa isa,
             int repetitions) {
    for (int i = 0; i < repetitions; ++i) {
        for (StrategiesRow& row : rows) {
            const render::RenderStatistics statistics = renderer.render(row.settings, isa).statistics;
            row.shadow_rays = statistics.shadow_rays;
            row.render_seconds.push_back(statistics.render_seconds);
            row.shading_seconds.push_back(statistics.shading_seconds);
        }
    }
}

/// The median over repetitions of the ratio of times.
double median_ratio(const std::vector<double>& times, const std::vector<double>& others) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < times.size(); ++i) ratios.push_back(times[i] / others[i]);
    return median(std::move(ratios));
}

lab::ResultTable table_of(const std::vector<StrategiesRow>& rows) {
    lab::ResultTable table = {"strategies",
                              {{"strategies"},
                               {"shadow_rays"},
                               {"render_seconds", "s"},
                               {"shading_seconds", "s"},
                               {"render_ratio"},
                               {"shading_ratio"}}};
    for (const StrategiesRow& row : rows)
        table.rows.push_back({row.name, row.shadow_rays, median(row.render_seconds),
                              median(row.shading_seconds),
                              median_ratio(row.render_seconds, rows[0].render_seconds),
                              median_ratio(row.shading_seconds, rows[0].shading_seconds)});
    return table;
}

void print_table(const std::vector<StrategiesRow>& rows) {
    fmt::print("{:<24}{:>14}{:>12}{:>12}{:>14}{:>14}\n", "strategies", "shadow rays", "render ms",
               "shading ms", "render ratio", "shading ratio");
    for (const StrategiesRow& row : rows)
        fmt::print("{:<24}{:>14}{:>12.2f}{:>12.2f}{:>14.2f}{:>14.2f}\n", row.name, row.shadow_rays,
                   1e3 * median(row.render_seconds), 1e3 * median(row.shading_seconds),
                   median_ratio(row.render_seconds, rows[0].render_seconds),
                   median_ratio(row.shading_seconds, rows[0].shading_seconds));
}

} // namespace

void setup_bench_strategies(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchStrategiesOptions>();
    CLI::App* command =
        bench.add_subcommand("strategies", "Cost of a second technique for the specular component, with "
                                           "clamped optimal multiple importance sampling. "
                                           "Prints times of frames, and their ratios to one diffuse sample. "
                                           "Shading is everything except tracing, summed "
                                           "over threads. Medians of interleaved runs.");
    add_frame_options(*command, *options, "pixel, light and technique");
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_strategies(*options); });
}

int run_bench_strategies(const BenchStrategiesOptions& options) {
    const base::Isa isa = base::choose_isa(options.isa);
    const int threads = render_cpu::checked_thread_count(options.threads);
    scene::Scene scene = load_scene(options.scene, options.json);
    apply_resolution(options.resolution, scene);
    const render_cpu::Renderer renderer(scene, threads);
    std::vector<StrategiesRow> rows = make_rows(options.samples);
    measure(rows, renderer, isa, options.repetitions);
    const lab::Results results = {
        "strategies", frame_settings(options, scene, isa, threads), {table_of(rows)}};
    write_results(options.json, results, [&] { print_table(rows); });
    return 0;
}

} // namespace nusselt::app
