#include "commands.h"
#include "render_setup.h"

#include "image/atomic_file.h"
#include "render_cpu/flush_denormals.h"
#include "render_cpu/renderer.h"
#include "scene/load.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <memory>

namespace nusselt::app {

namespace {

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

template <int N>
struct Query {
    std::uint32_t active;
    visibility::RayPacket<N> rays;
};

/// The rays that one thread traced for one tile after another.
template <int N>
struct Recording {
    std::vector<Query<N>> primary;
    std::vector<Query<N>> shadow;
};

/// Stands between a kernel and the scene, and remembers all rays.
template <int N>
class Recorder {
public:
    explicit Recorder(const visibility::RayTracer& tracer) : inner_(tracer) {}

    visibility::RayTracer tracer() const {
        visibility::RayTracer result = inner_;
        static_cast<visibility::PacketTracer<N>&>(result) = {intersect, occluded};
        result.context = this;
        return result;
    }

    /// Traces all rays again and does nothing else, with all threads of the arena. Returns the time [s].
    double replay(tbb::task_arena& arena) const {
        const auto begin = std::chrono::steady_clock::now();
        arena.execute([&] {
            for (const Recording<N>& recording : recordings_) {
                for_each_query(recording.primary, [&](const Query<N>& query) {
                    visibility::HitPacket<N> hits;
                    inner().intersect(inner_.context, query.active, query.rays, hits);
                    return static_cast<std::uint32_t>(hits.triangle[0]);
                });
                for_each_query(recording.shadow, [&](const Query<N>& query) {
                    return inner().occluded(inner_.context, query.active, query.rays);
                });
            }
        });
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }

private:
    const visibility::PacketTracer<N>& inner() const { return inner_; }

    template <class Trace>
    static void for_each_query(const std::vector<Query<N>>& queries, Trace trace) {
        constexpr std::size_t kGrain = 64;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), kGrain), [&](const auto& range) {
            const render_cpu::FlushDenormals flush_denormals;
            std::uint32_t used = 0;
            for (std::size_t i = range.begin(); i < range.end(); ++i) used += trace(queries[i]);
            // Keeps the compiler from dropping the calls.
            [[maybe_unused]] volatile std::uint32_t sink = used;
        });
    }

    static void intersect(const void* context, std::uint32_t active, const visibility::RayPacket<N>& rays,
                          visibility::HitPacket<N>& hits) {
        const auto& self = *static_cast<const Recorder*>(context);
        self.recordings_.local().primary.push_back({active, rays});
        self.inner().intersect(self.inner_.context, active, rays, hits);
    }

    static std::uint32_t occluded(const void* context, std::uint32_t active,
                                  const visibility::RayPacket<N>& rays) {
        const auto& self = *static_cast<const Recorder*>(context);
        self.recordings_.local().shadow.push_back({active, rays});
        return self.inner().occluded(self.inner_.context, active, rays);
    }

    visibility::RayTracer inner_;
    mutable tbb::enumerable_thread_specific<Recording<N>> recordings_;
};

/// One technique: the same rays with and without everything else.
struct RaysRow {
    render_cpu::Technique technique;
    std::uint64_t primary_rays = 0;
    std::uint64_t shadow_rays = 0;
    double trace_seconds = 0;  ///< raw calls, median
    double render_seconds = 0; ///< whole render phase, median
    double ratio() const { return render_seconds / trace_seconds; }
};

template <int N>
RaysRow measure(const render_cpu::Renderer& renderer, const render_cpu::RenderSettings& settings,
                render_cpu::Isa isa, tbb::task_arena& arena, int repetitions) {
    const Recorder<N> recorder(renderer.visibility().tracer());
    const render_cpu::RenderResult recorded = renderer.render(settings, isa, recorder.tracer());
    std::vector<double> trace_seconds;
    std::vector<double> render_seconds;
    for (int i = 0; i < repetitions; ++i) {
        trace_seconds.push_back(recorder.replay(arena));
        render_seconds.push_back(renderer.render(settings, isa).statistics.render_seconds);
    }
    return {settings.technique, recorded.statistics.primary_rays, recorded.statistics.shadow_rays,
            median(trace_seconds), median(render_seconds)};
}

RaysRow measure(const render_cpu::Renderer& renderer, const render_cpu::RenderSettings& settings,
                render_cpu::Isa isa, tbb::task_arena& arena, int repetitions) {
    switch (isa) {
    case render_cpu::Isa::sse42:
        return measure<4>(renderer, settings, isa, arena, repetitions);
    case render_cpu::Isa::avx2:
        return measure<8>(renderer, settings, isa, arena, repetitions);
    case render_cpu::Isa::avx512:
        break;
    }
    return measure<16>(renderer, settings, isa, arena, repetitions);
}

std::string json_text(const BenchRaysOptions& options, const scene::Scene& scene, render_cpu::Isa isa,
                      int threads, const std::vector<RaysRow>& rows) {
    auto list = nlohmann::ordered_json::array();
    for (const RaysRow& row : rows)
        list.push_back({{"technique", render_cpu::name_of(row.technique)},
                        {"primary_rays", row.primary_rays},
                        {"shadow_rays", row.shadow_rays},
                        {"trace_seconds", row.trace_seconds},
                        {"render_seconds", row.render_seconds},
                        {"ratio", row.ratio()}});
    const nlohmann::ordered_json json = {{"scene", options.scene.string()},    {"width", scene.film.width},
                                         {"height", scene.film.height},        {"samples", options.samples},
                                         {"repetitions", options.repetitions}, {"threads", threads},
                                         {"isa", render_cpu::name_of(isa)},    {"techniques", list}};
    // Paths may hold bytes that are not UTF-8.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace

void setup_bench_rays(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchRaysOptions>();
    CLI::App* command = bench.add_subcommand(
        "rays",
        "For each technique: time of the render phase against the time that Embree alone takes for the\n"
        "same rays in the same packets. Medians of runs in turn.");
    command->add_option("SCENE", options->scene, "Scene file in pbrt syntax, version 3 or 4")->required();
    command->add_option("--spp", options->samples, "Samples per pixel and light, 1 to 64")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    command->add_option("--repetitions", options->repetitions, "Runs of each kind, 1 to 1000")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    add_machine_options(*command, options->threads, options->isa);
    add_resolution_option(*command, options->resolution);
    command->add_option(
        "--json", options->json,
        "Write the numbers as JSON to a file, or with - to the standard output instead of the\n"
        "table. Default: none");
    command->callback([options, &exit_code] { exit_code = run_bench_rays(*options); });
}

int run_bench_rays(const BenchRaysOptions& options) {
    const render_cpu::Isa isa = render_cpu::choose_isa(options.isa);
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
    for (const render_cpu::Technique technique : render_cpu::kTechniques) {
        render_cpu::RenderSettings settings;
        settings.technique = technique;
        settings.samples = options.samples;
        rows.push_back(measure(renderer, settings, isa, arena, options.repetitions));
        const RaysRow& row = rows.back();
        if (prints_table)
            fmt::print("{:<30}{:>14}{:>14}{:>12.2f}{:>12.2f}{:>8.3f}\n", render_cpu::name_of(technique),
                       row.primary_rays, row.shadow_rays, 1e3 * row.trace_seconds, 1e3 * row.render_seconds,
                       row.ratio());
    }
    if (!options.json) return 0;
    const std::string text = json_text(options, scene, isa, threads, rows);
    if (!prints_table)
        fmt::print("{}", text);
    else
        image::write_atomically(*options.json, [&](std::ostream& stream) { stream << text; });
    return 0;
}

} // namespace nusselt::app
