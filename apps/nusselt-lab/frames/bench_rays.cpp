#include "bench_rays.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "bench_frames.h"
#include "recorded_rays.h"

#include "render_cpu/renderer.h"
#include "scene/import/importers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
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

lab::Results results_of(const BenchRaysOptions& options, const scene::Scene& scene, base::Isa isa,
                        int threads, const std::vector<RaysRow>& rows) {
    lab::ResultTable table = {"techniques",
                              {{"technique"},
                               {"primary_rays"},
                               {"shadow_rays"},
                               {"trace_seconds", "s"},
                               {"render_seconds", "s"},
                               {"ratio"}}};
    for (const RaysRow& row : rows)
        table.rows.push_back({std::string(name_of(row.technique)), row.primary_rays, row.shadow_rays,
                              row.trace_seconds, row.render_seconds, row.ratio()});
    return {"rays", frame_settings(options, scene, isa, threads), {std::move(table)}};
}

void print_table(const std::vector<RaysRow>& rows) {
    fmt::print("{:<30}{:>14}{:>14}{:>12}{:>12}{:>8}\n", "technique", "primary rays", "shadow rays",
               "Embree ms", "render ms", "ratio");
    for (const RaysRow& row : rows)
        fmt::print("{:<30}{:>14}{:>14}{:>12.2f}{:>12.2f}{:>8.3f}\n", name_of(row.technique), row.primary_rays,
                   row.shadow_rays, 1e3 * row.trace_seconds, 1e3 * row.render_seconds, row.ratio());
}

} // namespace

void setup_bench_rays(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchRaysOptions>();
    CLI::App* command = bench.add_subcommand(
        "rays", "Time of the render phase with each technique, against that of Embree's functions alone for "
                "the same rays in "
                "the same packets, without any conversion. Medians of interleaved runs.");
    add_frame_options(*command, *options, "pixel and light");
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_rays(*options); });
}

int run_bench_rays(const BenchRaysOptions& options) {
    const base::Isa isa = base::choose_isa(options.isa);
    const int threads = render_cpu::checked_thread_count(options.threads);
    scene::Scene scene = load_scene(options.scene, options.json);
    apply_resolution(options.resolution, scene);
    const render_cpu::Renderer renderer(scene, threads);
    tbb::task_arena arena(threads);

    std::vector<RaysRow> rows;
    for (const render::Technique technique : render::kTechniques) {
        render::RenderSettings settings;
        settings.technique = technique;
        settings.samples = options.samples;
        rows.push_back(measure(renderer, settings, isa, arena, options.repetitions));
    }
    write_results(options.json, results_of(options, scene, isa, threads, rows), [&] { print_table(rows); });
    return 0;
}

} // namespace nusselt::app
