#include "bench_rays.h"
#include "apps/common/render_setup.h"
#include "bench_frames.h"
#include "recorded_rays.h"

#include "base/atomic_file.h"
#include "render_cpu/renderer.h"
#include "scene/import/importers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include <memory>

namespace nusselt::app {

namespace {

/// One technique: the same rays with and without everything else.
struct RaysRow {
    render::Technique technique;
    std::uint64_t primary_rays = 0;
    std::uint64_t shadow_rays = 0;
    double trace_seconds = 0;  ///< Embree's functions alone, the mean over the threads, median
    double render_seconds = 0; ///< whole render phase, median
    double ratio() const { return render_seconds / trace_seconds; }
};

RaysRow measure(const render_cpu::Renderer& renderer, const render::RenderSettings& settings, base::Isa isa,
                tbb::task_arena& arena, int repetitions) {
    const std::unique_ptr<RecordedRays> rays = record_rays(renderer, settings, isa);
    std::vector<double> trace_seconds;
    std::vector<double> render_seconds;
    for (int i = 0; i < repetitions; ++i) {
        const visibility::ReplaySeconds traced = rays->replay(arena);
        trace_seconds.push_back((traced.closest_hit + traced.shadow) / arena.max_concurrency());
        render_seconds.push_back(renderer.render(settings, isa).statistics.render_seconds);
    }
    return {settings.technique, rays->primary_count, rays->shadow_count, median(trace_seconds),
            median(render_seconds)};
}

std::string json_text(const BenchRaysOptions& options, const scene::Scene& scene, base::Isa isa, int threads,
                      const std::vector<RaysRow>& rows) {
    auto list = nlohmann::ordered_json::array();
    for (const RaysRow& row : rows)
        list.push_back({{"technique", render::name_of(row.technique)},
                        {"primary_rays", row.primary_rays},
                        {"shadow_rays", row.shadow_rays},
                        {"trace_seconds", row.trace_seconds},
                        {"render_seconds", row.render_seconds},
                        {"ratio", row.ratio()}});
    const nlohmann::ordered_json json = {{"scene", options.scene.string()},
                                         {"width", scene.film.width},
                                         {"height", scene.film.height},
                                         {"samples", options.samples},
                                         {"repetitions", options.repetitions},
                                         {"threads", threads},
                                         {"isa", name_of(isa)},
                                         {"techniques", list}};
    // Paths may hold bytes that are not UTF-8.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace

void setup_bench_rays(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchRaysOptions>();
    CLI::App* command = bench.add_subcommand(
        "rays",
        "For each technique: time of the render phase against the time that Embree's functions alone take\n"
        "for the same rays in the same packets, without any conversion. Medians of runs in turn.");
    add_frame_options(*command, *options, "pixel and light");
    command->add_option(
        "--json", options->json,
        "Write the numbers as JSON to a file, or with - to the standard output instead of the\n"
        "table. Default: none");
    command->callback([options, &exit_code] { exit_code = run_bench_rays(*options); });
}

int run_bench_rays(const BenchRaysOptions& options) {
    const base::Isa isa = base::choose_isa(options.isa);
    scene::Scene scene = scene::load_scene(options.scene);
    apply_resolution(options.resolution, scene);
    const int threads = options.threads.value_or(render_cpu::default_thread_count());
    const render_cpu::Renderer renderer(scene, threads);
    tbb::task_arena arena(threads);

    const bool prints_table = options.json != "-";
    if (prints_table)
        fmt::print("{:<30}{:>14}{:>14}{:>12}{:>12}{:>8}\n", "technique", "primary rays", "shadow rays",
                   "Embree ms", "render ms", "ratio");
    std::vector<RaysRow> rows;
    for (const render::Technique technique : render::kTechniques) {
        render::RenderSettings settings;
        settings.technique = technique;
        settings.samples = options.samples;
        rows.push_back(measure(renderer, settings, isa, arena, options.repetitions));
        const RaysRow& row = rows.back();
        if (prints_table)
            fmt::print("{:<30}{:>14}{:>14}{:>12.2f}{:>12.2f}{:>8.3f}\n", render::name_of(technique),
                       row.primary_rays, row.shadow_rays, 1e3 * row.trace_seconds, 1e3 * row.render_seconds,
                       row.ratio());
    }
    if (!options.json) return 0;
    const std::string text = json_text(options, scene, isa, threads, rows);
    if (!prints_table)
        fmt::print("{}", text);
    else
        base::write_atomically(*options.json, [&](std::ostream& stream) { stream << text; });
    return 0;
}

} // namespace nusselt::app
