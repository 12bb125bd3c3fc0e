#include "render_cpu/renderer.h"

#include "render_cpu/film.h"
#include "render_cpu/flush_denormals.h"

#include "tables/ltc_table.h"

#include <tbb/parallel_for.h>
#include <x86intrin.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <string>
#include <vector>

namespace nusselt::render_cpu {

namespace {

constexpr int kTileSize = 16;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Converts ticks of the time stamp counter by comparing it with the clock.
class TickClock {
public:
    double seconds() const { return seconds_since(begin_); }
    double seconds_per_tick() const {
        return seconds() / static_cast<double>(std::max<std::uint64_t>(__rdtsc() - begin_ticks_, 1));
    }

private:
    Clock::time_point begin_ = Clock::now();
    std::uint64_t begin_ticks_ = __rdtsc();
};

/// The tiles of the film that have some of these pixels, cut to them.
std::vector<Tile> make_tiles(const scene::PixelBounds& pixels) {
    std::vector<Tile> tiles;
    for (int y = pixels.y_begin; y < pixels.y_end; y += kTileSize - y % kTileSize)
        for (int x = pixels.x_begin; x < pixels.x_end; x += kTileSize - x % kTileSize)
            tiles.push_back({x, y, std::min(x + kTileSize - x % kTileSize, pixels.x_end),
                             std::min(y + kTileSize - y % kTileSize, pixels.y_end)});
    return tiles;
}

/// What finished tiles add up to; shared by all threads.
class Tally {
public:
    Tally(std::uint64_t pixel_count, const RenderMonitor& monitor)
        : pixel_count_(pixel_count), monitor_(monitor) {}

    void add(const Tile& tile, const TileStatistics& work) {
        const std::lock_guard lock(mutex_);
        work_.primary_ticks += work.primary_ticks;
        work_.shading_ticks += work.shading_ticks;
        work_.shadow_ticks += work.shadow_ticks;
        work_.primary_rays += work.primary_rays;
        work_.shadow_rays += work.shadow_rays;
        work_.rejected_samples += work.rejected_samples;
        finished_pixels_ += static_cast<std::uint64_t>(tile.x_end - tile.x_begin) *
                            static_cast<std::uint64_t>(tile.y_end - tile.y_begin);
        if (monitor_.progress) monitor_.progress(finished_fraction());
    }

    const TileStatistics& work() const { return work_; }
    double finished_fraction() const {
        return static_cast<double>(finished_pixels_) / static_cast<double>(pixel_count_);
    }

private:
    std::uint64_t pixel_count_;
    const RenderMonitor& monitor_;
    std::mutex mutex_;
    TileStatistics work_{};
    std::uint64_t finished_pixels_ = 0;
};

} // namespace

int default_thread_count() { return std::max(1, tbb::this_task_arena::max_concurrency()); }

Renderer::Renderer(const scene::Scene& scene, int thread_count)
    : scene_(scene),
      thread_count_(thread_count),
      // By default oneTBB refuses more threads than the machine runs at once, with a message of its own.
      thread_limit_(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(std::max(thread_count, default_thread_count()))),
      arena_(thread_count),
      arrays_(scene),
      embree_([&] {
          const auto begin = Clock::now();
          return arena_.execute([&] {
              visibility::EmbreeScene result(scene);
              build_seconds_ = seconds_since(begin);
              return result;
          });
      }()) {}

RenderResult Renderer::render(const RenderSettings& settings, Isa isa, const RenderMonitor& monitor) const {
    return render(settings, isa, embree_.tracer(), monitor);
}

RenderResult Renderer::render(const RenderSettings& settings, Isa isa, const visibility::RayTracer& tracer,
                              const RenderMonitor& monitor) const {
    validate(settings);
    RenderResult result;
    const scene::PixelBounds pixels = rendered_pixels(scene_.film);
    result.image = image::make_image(pixels.x_end - pixels.x_begin, pixels.y_end - pixels.y_begin);

    RenderJob job{};
    job.scene = arrays_.view(settings.brdf);
    if (uses_lobes(settings)) {
        const tables::LtcTable& ltc = tables::frostbite_ltc_table();
        job.scene.ltc = {ltc.entries.data(), ltc.roughnesses, ltc.inclinations, ltc.f0s};
    }
    job.tracer = tracer;
    job.technique = settings.technique;
    job.strategies = settings.strategies;
    job.mis = settings.mis;
    job.visibility_estimate = settings.visibility_estimate;
    job.sample_order = settings.sample_order;
    job.pixel_position = settings.pixel_position;
    job.seed = settings.seed;
    job.camera_rays = static_cast<std::uint32_t>(camera_ray_count(settings));
    job.light_samples = static_cast<std::uint32_t>(settings.samples) / job.camera_rays;
    job.pixels = result.image.pixels.data();

    const RenderTile render_tile = kernel_for(isa);
    const std::vector<Tile> tiles = make_tiles(pixels);
    Tally tally(result.image.pixels.size() / 3, monitor);
    const TickClock clock;
    arena_.execute([&] {
        tbb::parallel_for(std::size_t(0), tiles.size(), [&](std::size_t i) {
            if (monitor.cancel != nullptr && *monitor.cancel) return;
            const FlushDenormals flush_denormals;
            TileStatistics work{};
            render_tile(job, tiles[i], work);
            tally.add(tiles[i], work);
        });
    });

    const TileStatistics& work = tally.work();
    const double scale = clock.seconds_per_tick();
    result.statistics.build_seconds = build_seconds_;
    result.statistics.render_seconds = clock.seconds();
    result.statistics.primary_seconds = scale * static_cast<double>(work.primary_ticks);
    result.statistics.shading_seconds = scale * static_cast<double>(work.shading_ticks);
    result.statistics.shadow_seconds = scale * static_cast<double>(work.shadow_ticks);
    result.statistics.primary_rays = work.primary_rays;
    result.statistics.shadow_rays = work.shadow_rays;
    result.statistics.rejected_samples = work.rejected_samples;
    result.statistics.threads = thread_count_;
    result.finished_fraction = tally.finished_fraction();
    return result;
}

image::Metadata make_metadata(const RenderSettings& settings, Isa isa, const RenderResult& result) {
    image::Metadata metadata = {{"version", NUSSELT_VERSION},
                                {"technique", std::string(name_of(settings.technique))},
                                {"strategies", std::string(name_of(settings.strategies))},
                                {"samples", std::to_string(settings.samples)},
                                {"camera_rays", std::to_string(camera_ray_count(settings))},
                                {"pixel_position", std::string(name_of(settings.pixel_position))},
                                {"sampler", std::string(name_of(settings.sample_order))},
                                {"brdf", std::string(name_of(settings.brdf))},
                                {"seed", std::to_string(settings.seed)},
                                {"isa", std::string(name_of(isa))},
                                {"render_seconds", std::to_string(result.statistics.render_seconds)},
                                {"finished_fraction", std::to_string(result.finished_fraction)}};
    if (settings.strategies != Strategies::diffuse) {
        metadata["mis"] = std::string(name_of(settings.mis));
        metadata["visibility_estimate"] = std::to_string(settings.visibility_estimate);
    }
    return metadata;
}

} // namespace nusselt::render_cpu
