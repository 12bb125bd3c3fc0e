#include "bench_lines.h"
#include "apps/common/help.h"
#include "apps/common/line_options.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "bench_frames.h"
#include "recorded_rays.h"

#include "base/process_time.h"
#include "render_cpu/renderer.h"
#include "scene/import/importers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

/// Many lines per shading point and light.
struct LinesRow {
    render::RenderSettings settings;
    render::LineStatistics work = {};
    std::vector<double> visibility_over_ray = {}; ///< for each repetition
    std::vector<double> line_over_point = {};
    std::vector<double> visible_parts = {}; ///< [s]

    double per_light(std::uint64_t count) const {
        return static_cast<double>(count) / static_cast<double>(work.line_lights);
    }
    double per_line(std::uint64_t count) const {
        return static_cast<double>(count) / static_cast<double>(work.lines);
    }
};

struct LinesTable {
    std::uint64_t shadow_rays = 0;
    std::vector<double> shadow_ray; ///< [s], for each repetition
    std::vector<LinesRow> rows;
};

double per(double seconds, std::uint64_t count) { return seconds / static_cast<double>(count); }

struct MeasuredFrame {
    render::RenderStatistics work;
    double seconds;            ///< that threads ran for, in all
    double visibility_seconds; ///< of these, for visible parts of lines
};

/// Reading the clock of a thread for each light is too slow: it gives the total time, which ticks divide among the
/// lights.
MeasuredFrame render(const render_cpu::Renderer& renderer, const render::RenderSettings& settings,
                     base::Isa isa) {
    const double begin = base::process_seconds();
    const render::RenderStatistics work = renderer.render(settings, isa).statistics;
    const double seconds = base::process_seconds() - begin;
    const double ticked =
        work.primary_seconds + work.shading_seconds + work.shadow_seconds + work.lines.visibility_seconds;
    return {work, seconds, seconds * work.lines.visibility_seconds / ticked};
}

/// Interleaves the runs, so that other load on the machine affects lines and rays alike.
LinesTable measure(const render_cpu::Renderer& renderer, const BenchLinesOptions& options, base::Isa isa,
                   int threads) {
    render::RenderSettings points;
    points.samples = options.samples;
    points.camera_rays = 1;
    LinesTable table;
    for (const int count : options.counts) {
        render::RenderSettings lines = points;
        lines.samples = 1;
        apply_line_kind_options(options.lines, lines.lines);
        lines.light_samples = render::LightSamples::lines;
        lines.lines.count = count;
        lines.lines.many_occluders = render::ManyOccluders::lines;
        table.rows.push_back({lines});
    }
    const std::unique_ptr<RecordedRays> rays = record_rays(renderer, points, isa);
    table.shadow_rays = rays->shadow_count;
    if (table.shadow_rays == 0) throw std::runtime_error("no surface in the image faces a light");

    tbb::task_arena arena(threads);
    for (int i = 0; i < options.repetitions; ++i) {
        const double ray = per(rays->replay(arena).shadow, rays->shadow_count);
        const double point = per(render(renderer, points, isa).seconds, rays->shadow_count);
        table.shadow_ray.push_back(ray);
        for (LinesRow& row : table.rows) {
            const MeasuredFrame frame = render(renderer, row.settings, isa);
            row.work = frame.work.lines;
            if (row.work.lines == 0)
                throw std::runtime_error("no surface in the image faces a polygonal light");
            row.visible_parts.push_back(per(frame.visibility_seconds, row.work.lines));
            row.visibility_over_ray.push_back(row.visible_parts.back() / ray);
            row.line_over_point.push_back(per(frame.seconds, row.work.lines) / point);
        }
    }
    return table;
}

void print_table(const LinesTable& table) {
    fmt::print("{} shadow rays, {:.0f} ns each\n\n", table.shadow_rays, 1e9 * median(table.shadow_ray));
    fmt::print("{:>7}{:>12}{:>12}{:>12}{:>14}{:>12}{:>12}{:>8}\n", "lines", "ns / line", "in rays",
               "in points", "boxes", "triangles", "shadows", "parts");
    for (const LinesRow& row : table.rows)
        fmt::print("{:>7}{:>12.0f}{:>12.2f}{:>12.2f}{:>14.1f}{:>12.1f}{:>12.1f}{:>8.2f}\n",
                   row.settings.lines.count, 1e9 * median(row.visible_parts), median(row.visibility_over_ray),
                   median(row.line_over_point), row.per_light(row.work.box_tests),
                   row.per_light(row.work.triangle_tests), row.per_light(row.work.shadow_tests),
                   row.per_line(row.work.parts));
}

lab::Results results_of(const LinesTable& table, const BenchLinesOptions& options, const scene::Scene& scene,
                        base::Isa isa, int threads) {
    lab::ResultTable rows = {"lines",
                             {{"lines"},
                              {"traced_lines"},
                              {"visibility_ns", "ns"},
                              {"visibility_over_shadow_ray"},
                              {"line_over_point"},
                              {"boxes_per_light"},
                              {"triangles_per_light"},
                              {"shadows_per_light"},
                              {"parts_per_line"}}};
    for (const LinesRow& row : table.rows)
        rows.rows.push_back({row.settings.lines.count, row.work.lines, 1e9 * median(row.visible_parts),
                             median(row.visibility_over_ray), median(row.line_over_point),
                             row.per_light(row.work.box_tests), row.per_light(row.work.triangle_tests),
                             row.per_light(row.work.shadow_tests), row.per_line(row.work.parts)});
    lab::ResultTable ray = {"shadow_ray",
                            {{"shadow_rays"}, {"time", "ns"}},
                            {{table.shadow_rays, 1e9 * median(table.shadow_ray)}}};
    lab::Results results = {"lines", frame_settings(options, scene, isa, threads), {}};
    append_line_kind(table.rows.front().settings.lines, results.settings);
    results.tables = {std::move(rows), std::move(ray)};
    return results;
}

} // namespace

void setup_bench_lines(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchLinesOptions>();
    CLI::App* command =
        bench.add_subcommand("lines", "Cost of line samples. Prints the time to find the visible parts of a "
                                      "line, over the time of Embree's "
                                      "functions alone for a shadow ray to a point of the same light from "
                                      "the same shading point, in packets; and the "
                                      "time of the whole render phase per line, over that per point. Then, "
                                      "for each shading point and light: boxes "
                                      "and triangles tested, and shadows of triangles compared with packs of "
                                      "lines; and visible parts per line. "
                                      "Medians of interleaved runs.");
    add_frame_options(*command, *options, "pixel and light for the rendering with points");
    command->add_option("--lines", options->counts, "Lines per shading point and light")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->transform(to_whole_number(1, render::kMaxLines))
        ->group(kLinesGroup);
    add_line_kind_options(*command, options->lines);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_lines(*options); });
}

int run_bench_lines(const BenchLinesOptions& options) {
    const base::Isa isa = base::choose_isa(options.isa);
    const int threads = render_cpu::checked_thread_count(options.threads);
    scene::Scene scene = load_scene(options.scene, options.json);
    apply_resolution(options.resolution, scene);
    const render_cpu::Renderer renderer(scene, threads);
    const LinesTable table = measure(renderer, options, isa, threads);
    write_results(options.json, results_of(table, options, scene, isa, threads), [&] { print_table(table); });
    return 0;
}

} // namespace nusselt::app
