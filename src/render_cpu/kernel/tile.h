#pragma once
/// Rendering of a tile: camera rays, what they hit, and what that emits and reflects.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/layers.h"
#include "render_cpu/kernel/light_functions.h"
#include "render_cpu/kernel/pixel_output.h"
#include "render_cpu/kernel/surface.h"
#include "render_cpu/kernel/tick_timer.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

// The pixels of a packet form a block, so that its rays stay close together.
inline constexpr int kBlockWidth = kLanes >= 8 ? 4 : 2;
inline constexpr int kBlockHeight = kLanes / kBlockWidth;

class TileRenderer {
public:
    TileRenderer(const render_cpu::RenderJob& job, const render_cpu::Tile& tile,
                 const render_cpu::TileMemory& memory, render_cpu::TileStatistics& statistics) noexcept
        : job_(job),
          tile_(tile),
          statistics_(statistics),
          functions_(light_functions(job)),
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

    /// All but shading.
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

    /// Radiance that arrives at the camera along one ray per pixel, times the weight of the ray.
    Vector weighted_radiance(const PixelBlock& block, std::uint32_t camera_ray) noexcept {
        const scene::Camera& camera = job_.scene.camera;
        const CameraSamples samples = camera_samples(job_, block, camera_ray);
        const Vector origin = linear(samples.raster, camera.origin, camera.origin_right, camera.origin_down);
        const Vector direction = linear(samples.raster, camera.corner, camera.right, camera.down);
        if (layers_ != nullptr) layers_->begin_ray(samples.weight);
        return samples.weight * radiance(block, camera_ray, origin, direction);
    }

    Vector radiance(const PixelBlock& block, std::uint32_t camera_ray, const Vector& origin,
                    const Vector& direction) noexcept {
        const visibility::HitPacket<kLanes> hits = trace(block.traced.bits(), origin, direction);
        std::uint32_t on_triangle = 0;
        std::uint32_t on_tube = 0;
        for (int i = 0; i < kLanes; ++i) {
            on_triangle |= static_cast<std::uint32_t>(hits.triangle[i] >= 0) << i;
            on_tube |= static_cast<std::uint32_t>(hits.tube[i] >= 0) << i;
        }
        const Vector emitted = emission(hits, direction);
        if (layers_ != nullptr) {
            layers_->add_hits(hits, LaneMask::from_bits(on_triangle | on_tube), direction);
            layers_->add_emission(hits, emitted);
        }
        if (on_triangle == 0) return emitted;

        const Surface surface =
            make_surface(job_.scene, hits, LaneMask::from_bits(on_triangle), -normalize(direction));
        if (layers_ != nullptr) layers_->add_surface(surface);
        ReflectedLight reflected(job_, block, surface, camera_ray, layers_, line_memory_, statistics_);
        for (std::int32_t i = 0; i < job_.scene.polygon_light_count; ++i) {
            const bool is_small = job_.scene.polygon_lights[i].slots == 4;
            (is_small ? functions_.add_polygon4 : functions_.add_polygon8)(reflected, i);
        }
        for (std::int32_t i = 0; i < job_.scene.line_light_count; ++i) {
            const bool is_solid = job_.scene.line_lights[i].model == scene::TubeModel::solid;
            (is_solid ? functions_.add_tube : functions_.add_line)(reflected, i);
        }
        return emitted + reflected.radiance();
    }

    visibility::HitPacket<kLanes> trace(std::uint32_t active, const Vector& origin,
                                        const Vector& direction) noexcept {
        visibility::RayPacket<kLanes> rays;
        origin.x.store(rays.origin[0]);
        origin.y.store(rays.origin[1]);
        origin.z.store(rays.origin[2]);
        direction.x.store(rays.direction[0]);
        direction.y.store(rays.direction[1]);
        direction.z.store(rays.direction[2]);
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        Real(kInfinity).store(rays.t_far);
        visibility::HitPacket<kLanes> hits;
        const visibility::PacketTracer<kLanes>& tracer = job_.tracer;
        statistics_.primary_rays += static_cast<std::uint64_t>(__builtin_popcount(active));
        const TickTimer timer(statistics_.primary_ticks);
        tracer.intersect(job_.tracer.context, active, rays, hits);
        return hits;
    }

    /// Radiance that the camera sees of lights themselves.
    Vector emission(const visibility::HitPacket<kLanes>& hits, const Vector& direction) const noexcept {
        Indices polygon;
        bool any_light = false;
        for (int i = 0; i < kLanes; ++i) {
            polygon.lane[i] = hits.triangle[i] < 0 ? -1 : job_.scene.triangle_light[hits.triangle[i]];
            any_light |= (polygon.lane[i] >= 0) | (hits.tube[i] >= 0);
        }
        Lanes result{};
        if (!any_light) return load(result);
        const Lanes d = store(direction);
        for (int i = 0; i < kLanes; ++i) {
            scene::Float3 emitted{0, 0, 0};
            if (hits.tube[i] >= 0) emitted = job_.scene.line_lights[hits.tube[i]].radiance;
            if (polygon.lane[i] >= 0) {
                const render_cpu::PolygonLightRecord& light = job_.scene.polygon_lights[polygon.lane[i]];
                const Vec3<float> ray{d.x[i], d.y[i], d.z[i]};
                if (light.two_sided != 0 || dot(to_vec(light.normal), ray) < 0) emitted = light.radiance;
            }
            result.x[i] = emitted.x;
            result.y[i] = emitted.y;
            result.z[i] = emitted.z;
        }
        return load(result);
    }

    const render_cpu::RenderJob& job_;
    render_cpu::Tile tile_;
    render_cpu::TileStatistics& statistics_;
    LightFunctions functions_;
    void* line_memory_;
    LayerSums layer_sums_;
    LayerSums* layers_; ///< null if the job has none
};

} // namespace kernel
NUSSELT_NAMESPACE_END
