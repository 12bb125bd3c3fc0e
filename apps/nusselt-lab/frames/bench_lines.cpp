#include "bench_lines.h"
#include "apps/common/line_options.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "bench_frames.h"
#include "recorded_rays.h"

#include "base/process_time.h"
#include "render_cpu/renderer.h"
#include "scene/import/importers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

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

/// Clocks of threads are too slow to be read for each light: they give the whole, which ticks share out.
MeasuredFrame render(const render_cpu::Renderer& renderer, const render::RenderSettings& settings,
                     base::Isa isa) {
    const double begin = base::process_seconds();
    const render::RenderStatistics work = renderer.render(settings, isa).statistics;
    const double seconds = base::process_seconds() - begin;
    const double ticked =
        work.primary_seconds + work.shading_seconds + work.shadow_seconds + work.lines.visibility_seconds;
    return {work, seconds, seconds * work.lines.visibility_seconds / ticked};
}

/// In turn, so that whatever else happens on the machine concerns lines and rays.
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

std::string to_json(const LinesTable& table, const BenchLinesOptions& options, const scene::Scene& scene,
                    base::Isa isa, int threads) {
    auto list = nlohmann::ordered_json::array();
    for (const LinesRow& row : table.rows)
        list.push_back({{"lines", row.settings.lines.count},
                        {"traced_lines", row.work.lines},
                        {"visibility_nanoseconds", 1e9 * median(row.visible_parts)},
                        {"visibility_over_shadow_ray", median(row.visibility_over_ray)},
                        {"line_over_point", median(row.line_over_point)},
                        {"boxes_per_light", row.per_light(row.work.box_tests)},
                        {"triangles_per_light", row.per_light(row.work.triangle_tests)},
                        {"shadows_per_light", row.per_light(row.work.shadow_tests)},
                        {"parts_per_line", row.per_line(row.work.parts)}});
    nlohmann::ordered_json json = {
        {"scene", options.scene.string()}, {"width", scene.film.width}, {"height", scene.film.height}};
    json.update(line_kind_json(table.rows.front().settings.lines));
    json.update({{"samples", options.samples},
                 {"repetitions", options.repetitions},
                 {"threads", threads},
                 {"isa", name_of(isa)},
                 {"shadow_rays", table.shadow_rays},
                 {"shadow_ray_nanoseconds", 1e9 * median(table.shadow_ray)},
                 {"rows", list}});
    // Paths may hold bytes that are not UTF-8.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace

void setup_bench_lines(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchLinesOptions>();
    CLI::App* command = bench.add_subcommand(
        "lines",
        "What line samples cost: time for the visible parts of a line, over that of Embree's functions "
        "alone\n"
        "for a shadow ray to a point of the same light from the same shading point, in packets; and of the\n"
        "whole render phase for each line, over that for each point. Then, for each shading point and\n"
        "light: boxes and triangles tested, and shadows of triangles that were compared with packs of lines; "
        "and\n"
        "visible parts for each line. Medians of runs in turn.");
    add_frame_options(*command, *options, "pixel and light, of the rendering with points");
    command->add_option("--lines", options->counts, "Lines per shading point and light, separated by commas")
        ->delimiter(',')
        ->check(CLI::Range(1, render::kMaxLines))
        ->capture_default_str();
    add_line_kind_options(*command, options->lines);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_lines(*options); });
}

int run_bench_lines(const BenchLinesOptions& options) {
    const base::Isa isa = base::choose_isa(options.isa);
    scene::Scene scene = scene::load_scene(options.scene);
    apply_resolution(options.resolution, scene);
    const int threads = options.threads.value_or(render_cpu::default_thread_count());
    const render_cpu::Renderer renderer(scene, threads);
    const LinesTable table = measure(renderer, options, isa, threads);
    write_results(options.json, to_json(table, options, scene, isa, threads), [&] { print_table(table); });
    return 0;
}

} // namespace nusselt::app
