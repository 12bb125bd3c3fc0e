#include "render_cpu/renderer.h"

#include "base/flush_denormals.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "render/choices/line_choice.h"
#include "render/film.h"
#include "render/memory.h"
#include "render_cpu/begun_tile.h"
#include "render_cpu/frame_targets.h"

#include "tables/blue_noise.h"
#include "tables/ltc_table.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <x86intrin.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::render_cpu {

namespace {

/// Converts ticks of the time stamp counter by comparing it with the clock.
class TickClock {
public:
    double seconds() const { return stopwatch_.seconds(); }
    double seconds_per_tick() const {
        return seconds() / static_cast<double>(std::max<std::uint64_t>(__rdtsc() - begin_ticks_, 1));
    }

private:
    base::Stopwatch stopwatch_;
    std::uint64_t begin_ticks_ = __rdtsc();
};

/// Sums over finished tiles, shared by all threads.
class Tally {
public:
    Tally(Frame& frame, const RenderMonitor& monitor) : frame_(frame), monitor_(monitor) {
        for (std::size_t i = 0; i < frame.tiles.size(); ++i) {
            all_pixels_ += pixel_count(frame.tiles[i]);
            if (frame.is_finished[i] != 0) finished_pixels_ += pixel_count(frame.tiles[i]);
        }
    }

    /// Adds the work of any tile.
    void add(const TileStatistics& work) {
        const std::lock_guard lock(mutex_);
        work_.primary_ticks += work.primary_ticks;
        work_.shading_ticks += work.shading_ticks;
        work_.shadow_ticks += work.shadow_ticks;
        work_.primary_rays += work.primary_rays;
        work_.shadow_rays += work.shadow_rays;
        work_.rejected_samples += work.rejected_samples;
        work_.line_visibility_ticks += work.line_visibility_ticks;
        work_.lines += work.lines;
        work_.line_parts += work.line_parts;
        work_.line_lights += work.line_lights;
        work_.point_lights += work.point_lights;
        work_.line_counters.box_tests += work.line_counters.box_tests;
        work_.line_counters.triangle_tests += work.line_counters.triangle_tests;
        work_.line_counters.line_tests += work.line_counters.line_tests;
    }

    void finish(std::size_t tile) {
        const std::lock_guard lock(mutex_);
        frame_.is_finished[tile] = 1;
        finished_pixels_ += pixel_count(frame_.tiles[tile]);
        if (monitor_.tile_finished) monitor_.tile_finished(tile);
        if (monitor_.progress)
            monitor_.progress(static_cast<double>(finished_pixels_) / static_cast<double>(all_pixels_));
    }

    /// Keeps a tile that is not finished.
    void keep(std::size_t tile, std::vector<std::byte> state) {
        const std::lock_guard lock(mutex_);
        kept_[tile] = std::move(state);
    }

    const TileStatistics& work() const { return work_; }

    /// The tiles that were begun, now or before, and are not finished.
    BegunTiles take_begun() {
        kept_.merge(*frame_.begun);
        std::erase_if(kept_, [&](const auto& tile) { return frame_.is_finished[tile.first] != 0; });
        return std::move(kept_);
    }

private:
    Frame& frame_;
    const RenderMonitor& monitor_;
    std::mutex mutex_;
    TileStatistics work_{};
    BegunTiles kept_;
    std::uint64_t all_pixels_ = 0;
    std::uint64_t finished_pixels_ = 0;
};

/// What kernels need [bytes].
constexpr std::size_t kMemoryAlignment = 64;

/// Working memory of one thread, aligned as kernels need it. All sizes are multiples of the alignment.
class ThreadMemory {
public:
    /// \param sum_bytes  for a packet, then for layers of lights
    /// \param kept_bytes for layers of lights
    ThreadMemory(std::size_t sum_bytes, std::size_t kept_bytes, std::size_t line_bytes)
        : sums_(sum_bytes / sizeof(Block)),
          // The pages that nothing is written to take no memory.
          kept_(std::make_unique_for_overwrite<Block[]>(kept_bytes / sizeof(Block))),
          lines_(line_bytes / sizeof(Block)) {}

    TileMemory view() {
        return {sums_.data(), sums_.front().floats + kPacketSumBytes / sizeof(float),
                reinterpret_cast<float*>(kept_.get()), lines_.data()};
    }
    std::span<std::byte> sums() { return std::as_writable_bytes(std::span(sums_)); }

private:
    struct alignas(kMemoryAlignment) Block {
        float floats[kMemoryAlignment / sizeof(float)];
    };
    std::vector<Block> sums_;
    std::unique_ptr<Block[]> kept_;
    std::vector<Block> lines_;
};

/// What RenderJob::stop_requested points to: without a request, nothing ever stops.
const unsigned char* bytes_of(const std::atomic<bool>* cancel) {
    static constexpr unsigned char kNever = 0;
    static_assert(sizeof(*cancel) == 1 && std::atomic<bool>::is_always_lock_free);
    return cancel == nullptr ? &kNever : reinterpret_cast<const unsigned char*>(cancel);
}

/// The memory for the sums of layers of lights of one packet of pixels.
std::size_t light_sum_bytes(const scene::Scene& scene, const RenderSettings& settings, base::Isa isa) {
    if (!is_wanted(settings, LayerKind::lights)) return 0;
    const std::size_t floats = kLightSumFloatsPerLane * static_cast<std::size_t>(lane_count(isa));
    const std::size_t bytes = scene.emitters.size() * floats * sizeof(float);
    return (bytes + kMemoryAlignment - 1) / kMemoryAlignment * kMemoryAlignment;
}

/// The memory to keep them, in addition.
std::size_t kept_sum_bytes(const scene::Scene& scene, const RenderSettings& settings, base::Isa isa) {
    return camera_ray_count(settings) > 1 ? light_sum_bytes(scene, settings, isa) : 0;
}

} // namespace

std::size_t layer_sum_bytes(const scene::Scene& scene, const RenderSettings& settings, base::Isa isa,
                            int threads) {
    const std::size_t busy = std::min(static_cast<std::size_t>(threads), frame_size(scene, settings).tiles);
    return busy * (light_sum_bytes(scene, settings, isa) + kept_sum_bytes(scene, settings, isa));
}

int default_thread_count() { return std::max(1, tbb::this_task_arena::max_concurrency()); }

int largest_thread_count(int count) { return std::max(count, default_thread_count()); }

int checked_thread_count(std::optional<int> count) {
    const int threads = count.value_or(default_thread_count());
    base::check_threads(largest_thread_count(threads));
    return threads;
}

Renderer::Renderer(const scene::Scene& scene, int thread_count, const Integrator& integrator,
                   std::span<const LightKernel> kernels)
    : scene_(scene),
      thread_count_(thread_count),
      integrator_(&integrator),
      // Otherwise oneTBB refuses more threads than the machine runs at once, with a message of its own.
      thread_limit_(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(largest_thread_count(thread_count))),
      arena_(thread_count),
      arrays_(scene, kernels),
      embree_([&] {
          const base::Stopwatch stopwatch;
          return arena_.execute([&] {
              visibility::EmbreeScene result(scene);
              build_seconds_ = stopwatch.seconds();
              return result;
          });
      }()) {}

visibility::LineBvhView Renderer::Lines::get(const scene::Scene& scene, tbb::task_arena& arena) {
    // After an exception, the next rendering tries again.
    std::call_once(once_, [&] {
        const base::Stopwatch stopwatch;
        arena.execute([&] { bvh_.emplace(scene); });
        build_seconds_ = stopwatch.seconds();
    });
    return bvh_->view();
}

RenderResult Renderer::render(const RenderSettings& settings, base::Isa isa,
                              const RenderMonitor& monitor) const {
    return render(settings, isa, embree_.tracer(), monitor);
}

RenderResult Renderer::render(const RenderSettings& settings, base::Isa isa,
                              const visibility::RayTracer& tracer, const RenderMonitor& monitor) const {
    validate(settings);
    Frame frame = make_frame(scene_, settings);
    const RenderStatistics statistics = render_into(frame, settings, isa, tracer, monitor);
    return to_result(std::move(frame), statistics);
}

RenderStatistics Renderer::render_into(Frame& frame, const RenderSettings& settings, base::Isa isa,
                                       const visibility::RayTracer& tracer,
                                       const RenderMonitor& monitor) const {
    check_memory(frame_size(scene_, settings).bytes + layer_sum_bytes(scene_, settings, isa, thread_count_),
                 "rendering these layers in " + std::to_string(thread_count_) + " threads",
                 "use a lower --resolution, fewer --layers or fewer --threads");
    const FrameTargets targets(frame);
    RenderJob job{};
    visibility::LineBvhView line_bvh{};
    job.scene = arrays_.view(settings.brdf);
    if (uses_lobes(settings)) {
        const auto record = [](const tables::LtcTable& table) -> LtcTableRecord {
            return {table.entries.data(), table.roughnesses, table.inclinations, table.f0s};
        };
        job.scene.frostbite_lobes = record(tables::frostbite_ltc_table());
        job.scene.phong_lobes = record(tables::phong_ltc_table());
    }
    job.tracer = tracer;
    job.light_samples = settings.light_samples;
    job.lines = settings.lines;
    if (settings.light_samples == LightSamples::lines && arrays_.take_lines()) {
        line_bvh = lines_.get(scene_, arena_);
        job.line_bvh = &line_bvh;
    }
    job.most_occluders = most_occluders_for_lines(settings.lines.count);
    job.technique = settings.technique;
    job.strategies = settings.strategies;
    job.emission_sampling = settings.emission_sampling;
    job.mis = settings.mis;
    job.visibility_estimate = settings.visibility_estimate;
    job.sample_order = settings.sample_order;
    job.blue_noise = tables::blue_noise().bytes;
    job.pixel_position = settings.pixel_position;
    job.seed = settings.seed;
    job.camera_rays = static_cast<std::uint32_t>(camera_ray_count(settings));
    job.samples_per_light = static_cast<std::uint32_t>(settings.samples) / job.camera_rays;
    job.points_in_place_of_lines = static_cast<std::uint32_t>(
        points_in_place_of_lines(settings.lines.count, camera_ray_count(settings)));
    job.x_begin = frame.bounds.x_begin;
    job.y_begin = frame.bounds.y_begin;
    job.width = frame.image.width;
    job.pixels = frame.image.pixels.data();
    job.rays = frame.rays.data();
    job.has_layers = !frame.layers.empty();
    job.layers = targets.layers();
    job.stop_requested = bytes_of(monitor.cancel);

    std::vector<LightSet> light_sets = arrays_.light_sets(isa);
    for (LightSet& set : light_sets) set.code.choose(job, set.add);
    job.scene.light_sets = light_sets.data();
    job.scene.light_set_count = static_cast<std::int32_t>(light_sets.size());

    const RenderTile render_tile = kernel_for(*integrator_, isa);
    const std::size_t sum_bytes = kPacketSumBytes + light_sum_bytes(scene_, settings, isa);
    const std::size_t kept_bytes = kept_sum_bytes(scene_, settings, isa);
    const std::size_t line_bytes = settings.light_samples == LightSamples::lines ? kLineMemoryBytes : 0;
    if (frame.begun)
        for (const auto& [tile, state] : *frame.begun) restore_pixels(frame, tile, state, sum_bytes);
    tbb::enumerable_thread_specific<ThreadMemory> memory(sum_bytes, kept_bytes, line_bytes);
    if (monitor.started) monitor.started();
    Tally tally(frame, monitor);
    const TickClock clock;
    arena_.execute([&] {
        tbb::parallel_for(std::size_t(0), frame.tiles.size(), [&](std::size_t i) {
            if (frame.is_finished[i] != 0 || (monitor.cancel != nullptr && *monitor.cancel)) return;
            const base::FlushDenormals flush_denormals;
            ThreadMemory& own = memory.local();
            TileStatistics work{};
            TileProgress progress{};
            if (frame.begun) {
                const auto begun = frame.begun->find(i);
                if (begun != frame.begun->end()) progress = restore_sums(begun->second, own.sums());
            }
            const bool is_finished = render_tile(job, frame.tiles[i], own.view(), progress, work);
            tally.add(work);
            if (is_finished)
                tally.finish(i);
            else if (frame.begun)
                tally.keep(i, store_begun_tile(frame, i, progress, own.sums()));
        });
    });
    if (frame.begun) frame.begun = tally.take_begun();

    const TileStatistics& work = tally.work();
    const double scale = clock.seconds_per_tick();
    RenderStatistics statistics;
    statistics.build_seconds = build_seconds_;
    statistics.render_seconds = clock.seconds();
    statistics.primary_seconds = scale * static_cast<double>(work.primary_ticks);
    statistics.shading_seconds = scale * static_cast<double>(work.shading_ticks);
    statistics.shadow_seconds = scale * static_cast<double>(work.shadow_ticks);
    statistics.primary_rays = work.primary_rays;
    statistics.shadow_rays = work.shadow_rays;
    statistics.rejected_samples = work.rejected_samples;
    statistics.lines.build_seconds = job.line_bvh == nullptr ? 0 : lines_.build_seconds();
    statistics.lines.visibility_seconds = scale * static_cast<double>(work.line_visibility_ticks);
    statistics.lines.lines = work.lines;
    statistics.lines.parts = work.line_parts;
    statistics.lines.line_lights = work.line_lights;
    statistics.lines.point_lights = work.point_lights;
    statistics.lines.box_tests = work.line_counters.box_tests;
    statistics.lines.triangle_tests = work.line_counters.triangle_tests;
    statistics.lines.shadow_tests = work.line_counters.line_tests;
    statistics.threads = thread_count_;
    return statistics;
}

} // namespace nusselt::render_cpu
