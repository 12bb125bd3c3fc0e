#pragma once
/// Renders tiles: makes camera rays, has an integrator compute their radiance, and sums it up.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/camera_packet.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/layers.h"
#include "render_cpu/kernel/pixel_output.h"
#include "render_cpu/kernel/stop_request.h"

#include <type_traits>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

// The pixels of a packet form a block, so that its rays stay close together.
inline constexpr int kBlockWidth = kLanes >= 8 ? 4 : 2;
inline constexpr int kBlockHeight = kLanes / kBlockWidth;

/// The sums of a packet of pixels over its camera rays, without those of lights.
struct PacketSums {
    CompensatedSum radiance;
    LayerSums::State layers;
};
static_assert(std::is_trivially_copyable_v<PacketSums> && sizeof(PacketSums) <= render_cpu::kPacketSumBytes,
              "renderers store bytes");

/// \tparam Integrator constructed from a job once per tile. Its radiance(packet, rays) returns the radiance that arrives
///                    along the rays, one per lane of the packet. See kernel/integrators.
template <class Integrator>
class TileRenderer {
public:
    TileRenderer(const render_cpu::RenderJob& job, const render_cpu::Tile& tile,
                 const render_cpu::TileMemory& memory, render_cpu::TileStatistics& statistics) noexcept
        : job_(job),
          tile_(tile),
          statistics_(statistics),
          integrator_(job),
          line_memory_(memory.lines),
          stop_(job.stop_requested),
          kept_(*static_cast<PacketSums*>(memory.packet_sums)),
          layer_sums_(job, memory),
          layers_(job.has_layers ? &layer_sums_ : nullptr) {}
    TileRenderer(const TileRenderer&) = delete;
    TileRenderer& operator=(const TileRenderer&) = delete;

    /// \copydoc render_cpu::RenderTile
    bool render(render_cpu::TileProgress& progress) noexcept {
        const std::int32_t x_begin = tile_.x_begin - tile_.x_begin % kBlockWidth;
        const std::int32_t y_begin = tile_.y_begin - tile_.y_begin % kBlockHeight;
        std::uint32_t packet = 0;
        for (std::int32_t y = y_begin; y < tile_.y_end; y += kBlockHeight)
            for (std::int32_t x = x_begin; x < tile_.x_end; x += kBlockWidth, ++packet) {
                if (packet < progress.packet) continue;
                render_block(x, y, progress.camera_ray);
                if (progress.camera_ray < job_.camera_rays) return false;
                progress = {packet + 1, 0};
            }
        return true;
    }

private:
    /// About a quarter of a millisecond, in ticks of the time stamp counter: no more than that is lost when a camera ray is
    /// given up, and copies of the sums of many lights take little time beside the rays.
    static constexpr std::uint64_t kKeepTicks = 1'000'000;

    /// \param camera_ray number of the first camera ray to trace; afterwards of the first that is missing
    void render_block(std::int32_t x_begin, std::int32_t y_begin, std::uint32_t& camera_ray) noexcept {
        const std::uint64_t begin = __builtin_ia32_rdtsc();
        const std::uint64_t traced_before = traced_ticks();
        const PixelBlock block = make_block(x_begin, y_begin);
        CompensatedSum sum;
        if (camera_ray > 0) {
            sum = kept_.radiance;
            if (layers_ != nullptr) layers_->resume(kept_.layers);
        } else if (layers_ != nullptr) {
            layers_->clear();
        }
        std::uint32_t kept_rays = camera_ray; // whose sums can be restored
        std::uint64_t kept_ticks = begin;
        for (; camera_ray < job_.camera_rays && !stop_.is_made(); ++camera_ray) {
            stop_.begin_ray();
            const Vector arriving = weighted_radiance(block, camera_ray);
            if (stop_.is_urgent()) {
                // The ray may lack lights, and the layers have some of them already.
                if (layers_ == nullptr) break;
                camera_ray = kept_rays;
                sum = kept_.radiance;
                if (kept_rays > 0) layers_->restore(kept_.layers);
                break;
            }
            sum.add(arriving);
            if (layers_ == nullptr) continue;
            layers_->add_radiance(arriving);
            const std::uint64_t now = __builtin_ia32_rdtsc();
            if (now - kept_ticks < kKeepTicks || camera_ray + 1 == job_.camera_rays) continue;
            kept_ = {sum, layers_->keep()};
            kept_rays = camera_ray + 1;
            kept_ticks = now;
        }
        if (camera_ray > 0) write(block, camera_ray, sum);
        statistics_.shading_ticks += __builtin_ia32_rdtsc() - begin - (traced_ticks() - traced_before);
    }

    /// Stores the means of the camera rays so far, and the sums if there are to be more.
    void write(const PixelBlock& block, std::uint32_t camera_rays, const CompensatedSum& sum) noexcept {
        const auto count = static_cast<float>(camera_rays);
        if (camera_rays < job_.camera_rays) {
            kept_.radiance = sum;
            if (layers_ != nullptr) kept_.layers = layers_->state();
            // A single camera ray tells no variance.
            if (camera_rays == 1 && job_.layers.variance != nullptr) return;
        }
        store_rgb(job_, block, Real(1.0f / count) * sum.sum, job_.pixels);
        store_grey(job_, block, Real(count), job_.rays);
        if (layers_ != nullptr) layers_->write(block);
    }

    /// The time for everything but shading.
    std::uint64_t traced_ticks() const noexcept {
        return statistics_.primary_ticks + statistics_.shadow_ticks + statistics_.line_visibility_ticks;
    }

    PixelBlock make_block(std::int32_t x_begin, std::int32_t y_begin) const noexcept {
        PixelBlock block;
        float x[kLanes];
        float y[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            const std::int32_t column = x_begin + i % kBlockWidth;
            const std::int32_t row = y_begin + i / kBlockWidth;
            block.x[i] = static_cast<std::uint32_t>(column);
            block.y[i] = static_cast<std::uint32_t>(row);
            x[i] = static_cast<float>(column);
            y[i] = static_cast<float>(row);
        }
        block.corner = {Real::load(x), Real::load(y)};
        const auto are_below = [&](std::int32_t x_end, std::int32_t y_end) {
            return (block.corner.x < Real(x_end)) & (block.corner.y < Real(y_end));
        };
        block.traced = are_below(job_.scene.film_width, job_.scene.film_height);
        block.inside = are_below(tile_.x_end, tile_.y_end) & (block.corner.x >= Real(tile_.x_begin)) &
                       (block.corner.y >= Real(tile_.y_begin));
        return block;
    }

    static Vector linear(const Vec2<Real>& raster, const scene::Float3& corner, const scene::Float3& right,
                         const scene::Float3& down) noexcept {
        return broadcast<Real>(to_vec(corner)) + raster.x * broadcast<Real>(to_vec(right)) +
               raster.y * broadcast<Real>(to_vec(down));
    }

    /// The radiance that arrives at the camera along one ray per pixel, times the weight of the ray.
    Vector weighted_radiance(const PixelBlock& block, std::uint32_t camera_ray) noexcept {
        const scene::Camera& camera = job_.scene.camera;
        const CameraSamples samples = camera_samples(job_, block, camera_ray);
        const Vector origin = linear(samples.raster, camera.origin, camera.origin_right, camera.origin_down);
        const Vector direction = linear(samples.raster, camera.corner, camera.right, camera.down);
        if (layers_ != nullptr) layers_->begin_ray(samples.weight);
        const CameraPacket packet{job_, block, camera_ray, layers_, line_memory_, stop_, statistics_};
        return samples.weight * integrator_.radiance(packet, {block.traced.bits(), origin, direction});
    }

    const render_cpu::RenderJob& job_;
    render_cpu::Tile tile_;
    render_cpu::TileStatistics& statistics_;
    Integrator integrator_;
    void* line_memory_;
    StopRequest stop_;
    PacketSums& kept_; ///< of an unfinished packet
    LayerSums layer_sums_;
    LayerSums* layers_; ///< null if the job has none
};

/// The function of a kernel, see render_cpu::RenderTile.
template <class Integrator>
bool render_tile(const render_cpu::RenderJob& job, const render_cpu::Tile& tile,
                 const render_cpu::TileMemory& memory, render_cpu::TileProgress& progress,
                 render_cpu::TileStatistics& statistics) {
    return TileRenderer<Integrator>(job, tile, memory, statistics).render(progress);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
