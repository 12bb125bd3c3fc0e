#pragma once
/// Renders tiles: makes camera rays, has an integrator compute their radiance, and sums it up.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/camera_packet.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/layers.h"
#include "render_cpu/kernel/pixel_output.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

// The pixels of a packet form a block, so that its rays stay close together.
inline constexpr int kBlockWidth = kLanes >= 8 ? 4 : 2;
inline constexpr int kBlockHeight = kLanes / kBlockWidth;

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
          layer_sums_(job, memory.light_sums),
          layers_(job.has_layers ? &layer_sums_ : nullptr) {}
    TileRenderer(const TileRenderer&) = delete;
    TileRenderer& operator=(const TileRenderer&) = delete;

    void render() noexcept {
        const std::int32_t x_begin = tile_.x_begin - tile_.x_begin % kBlockWidth;
        const std::int32_t y_begin = tile_.y_begin - tile_.y_begin % kBlockHeight;
        for (std::int32_t y = y_begin; y < tile_.y_end; y += kBlockHeight)
            for (std::int32_t x = x_begin; x < tile_.x_end; x += kBlockWidth) render_block(x, y);
    }

private:
    void render_block(std::int32_t x_begin, std::int32_t y_begin) noexcept {
        const std::uint64_t begin = __builtin_ia32_rdtsc();
        const std::uint64_t traced_before = traced_ticks();
        const PixelBlock block = make_block(x_begin, y_begin);
        CompensatedSum sum;
        if (layers_ != nullptr) layers_->clear();
        for (std::uint32_t i = 0; i < job_.camera_rays; ++i) {
            const Vector arriving = weighted_radiance(block, i);
            sum.add(arriving);
            if (layers_ != nullptr) layers_->add_radiance(arriving);
        }
        store_rgb(job_, block, Real(1.0f / static_cast<float>(job_.camera_rays)) * sum.sum, job_.pixels);
        if (layers_ != nullptr) layers_->write(block);
        statistics_.shading_ticks += __builtin_ia32_rdtsc() - begin - (traced_ticks() - traced_before);
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
        const CameraPacket packet{job_, block, camera_ray, layers_, line_memory_, statistics_};
        return samples.weight * integrator_.radiance(packet, {block.traced.bits(), origin, direction});
    }

    const render_cpu::RenderJob& job_;
    render_cpu::Tile tile_;
    render_cpu::TileStatistics& statistics_;
    Integrator integrator_;
    void* line_memory_;
    LayerSums layer_sums_;
    LayerSums* layers_; ///< null if the job has none
};

/// The function of a kernel, see render_cpu::RenderTile.
template <class Integrator>
void render_tile(const render_cpu::RenderJob& job, const render_cpu::Tile& tile,
                 const render_cpu::TileMemory& memory, render_cpu::TileStatistics& statistics) {
    TileRenderer<Integrator>(job, tile, memory, statistics).render();
}

} // namespace kernel
NUSSELT_NAMESPACE_END
