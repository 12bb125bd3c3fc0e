#pragma once
/// Rendering of a tile: camera rays, what they hit, and what that emits and reflects.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/layers.h"
#include "render_cpu/kernel/light_functions.h"
#include "render_cpu/kernel/pixel_output.h"
#include "render_cpu/kernel/surface.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

// The pixels of a packet form a block, so that its rays stay close together.
inline constexpr int kBlockWidth = kLanes >= 8 ? 4 : 2;
inline constexpr int kBlockHeight = kLanes / kBlockWidth;

class TileRenderer {
public:
    /// \param light_sums see RenderTile
    TileRenderer(const render_cpu::RenderJob& job, const render_cpu::Tile& tile, float* light_sums,
                 render_cpu::TileStatistics& statistics) noexcept
        : job_(job),
          tile_(tile),
          statistics_(statistics),
          functions_(light_functions(job)),
          layer_sums_(job, light_sums),
          layers_(job.has_layers ? &layer_sums_ : nullptr) {}
    TileRenderer(const TileRenderer&) = delete;
    TileRenderer& operator=(const TileRenderer&) = delete;

    void render() noexcept {
        for (std::int32_t y = tile_.y_begin; y < tile_.y_end; y += kBlockHeight)
            for (std::int32_t x = tile_.x_begin; x < tile_.x_end; x += kBlockWidth) render_block(x, y);
    }

private:
    void render_block(std::int32_t x_begin, std::int32_t y_begin) noexcept {
        const std::uint64_t begin = __builtin_ia32_rdtsc();
        const std::uint64_t traced_before = statistics_.primary_ticks + statistics_.shadow_ticks;
        const PixelBlock block = make_block(x_begin, y_begin);
        CompensatedSum sum;
        if (layers_ != nullptr) layers_->clear();
        for (std::uint32_t i = 0; i < job_.camera_rays; ++i) {
            const Vector arriving = radiance(block, i);
            sum.add(arriving);
            if (layers_ != nullptr) layers_->add_radiance(arriving);
        }
        store_rgb(job_, block, Real(1.0f / static_cast<float>(job_.camera_rays)) * sum.sum, job_.pixels);
        if (layers_ != nullptr) layers_->write(block);
        const std::uint64_t traced = statistics_.primary_ticks + statistics_.shadow_ticks - traced_before;
        statistics_.shading_ticks += __builtin_ia32_rdtsc() - begin - traced;
    }

    PixelBlock make_block(std::int32_t x_begin, std::int32_t y_begin) const noexcept {
        PixelBlock block;
        std::uint32_t inside = 0;
        for (int i = 0; i < kLanes; ++i) {
            const std::int32_t x = x_begin + i % kBlockWidth;
            const std::int32_t y = y_begin + i / kBlockWidth;
            block.x[i] = static_cast<std::uint32_t>(x);
            block.y[i] = static_cast<std::uint32_t>(y);
            inside |= static_cast<std::uint32_t>(x < tile_.x_end && y < tile_.y_end) << i;
        }
        block.inside = LaneMask::from_bits(inside);
        return block;
    }

    Vector camera_direction(const PixelBlock& block, std::uint32_t camera_ray) const noexcept {
        const Vec2<Real> raster = raster_positions(job_, block, camera_ray);
        const scene::Camera& camera = job_.scene.camera;
        return broadcast<Real>(to_vec(camera.corner)) + raster.x * broadcast<Real>(to_vec(camera.right)) +
               raster.y * broadcast<Real>(to_vec(camera.down));
    }

    /// Radiance that arrives at the camera along one ray per pixel.
    Vector radiance(const PixelBlock& block, std::uint32_t camera_ray) noexcept {
        const Vector direction = camera_direction(block, camera_ray);
        const visibility::HitPacket<kLanes> hits = trace(block.inside.bits(), direction);
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
        ReflectedLight reflected(job_, block, surface, camera_ray, layers_, statistics_);
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

    visibility::HitPacket<kLanes> trace(std::uint32_t active, const Vector& direction) noexcept {
        visibility::RayPacket<kLanes> rays;
        const Vec3<float> origin = to_vec(job_.scene.camera.origin);
        Real(origin.x).store(rays.origin[0]);
        Real(origin.y).store(rays.origin[1]);
        Real(origin.z).store(rays.origin[2]);
        direction.x.store(rays.direction[0]);
        direction.y.store(rays.direction[1]);
        direction.z.store(rays.direction[2]);
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        Real(kInfinity).store(rays.t_far);
        visibility::HitPacket<kLanes> hits;
        const visibility::PacketTracer<kLanes>& tracer = job_.tracer;
        const std::uint64_t begin = __builtin_ia32_rdtsc();
        tracer.intersect(job_.tracer.context, active, rays, hits);
        statistics_.primary_ticks += __builtin_ia32_rdtsc() - begin;
        statistics_.primary_rays += static_cast<std::uint64_t>(__builtin_popcount(active));
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
    LayerSums layer_sums_;
    LayerSums* layers_; ///< null if the job has none
};

} // namespace kernel
NUSSELT_NAMESPACE_END
