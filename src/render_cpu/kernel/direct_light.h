#pragma once
/// Direct light from each polygon and line at a packet of shading points.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/random.h"
#include "render_cpu/kernel/surface.h"

#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Share of the way to the light that shadow rays trace. They must stop before the light, which is in the scene
/// itself: single precision puts the sampled point, and the triangles around it, up to some 1e-6 of the way
/// off. Occluders within the last 1e-4 of the way are missed.
inline constexpr float kShadowRayEnd = 1 - 1e-4f;

/// Lanes whose components are neither NaN nor infinite.
inline LaneMask is_finite(const Vector& v) noexcept {
    return is_finite(v.x) & is_finite(v.y) & is_finite(v.z);
}

/// Estimates the light that one packet of shading points reflects to the eye.
class DirectLight {
public:
    /// \param camera_ray number of the camera rays of this packet, below job.camera_rays
    DirectLight(const render_cpu::RenderJob& job, const PixelBlock& block, const Surface& surface,
                std::uint32_t camera_ray, render_cpu::TileStatistics& statistics) noexcept
        : job_(job),
          block_(block),
          surface_(surface),
          first_sample_(camera_ray * job.light_samples),
          statistics_(statistics) {}

    /// Adds the mean over the samples of one light: reflected radiance [W/(sr m^2)].
    template <template <class, int> class Technique, int N>
    void add_polygon(std::int32_t index) noexcept {
        const render_cpu::PolygonLightRecord& record = job_.scene.polygon_lights[index];
        ConvexPolygon<float, N> world;
        for (int j = 0; j < N; ++j) {
            world.vertex[j] = to_vec(record.vertex[j]);
            world.edge[j] = to_vec(record.edge[j]);
        }
        world.normal = to_vec(record.normal);
        const auto local = to_shading_space(world, surface_.position, surface_.frame);

        LaneMask lit = surface_.valid & !is_part_of_light(index);
        // Comparisons with NaN are false: negated they keep it, so that it is counted.
        if (record.two_sided == 0) lit &= !(dot(local.normal, local.vertex[0]) >= Real(0));
        Real highest = local.vertex[0].z;
        for (int j = 1; j < N; ++j) highest = max(highest, local.vertex[j].z);
        lit &= !(highest <= Real(0));
        if (!any(lit)) return;
        const Technique<Real, N> technique(local);
        add(lit, static_cast<std::uint32_t>(index), to_vec(record.radiance),
            [&](const Vec2<Real>& u) { return technique.sample(u); });
    }

    /// \copydoc add_polygon
    template <template <class> class Technique>
    void add_line(std::int32_t index) noexcept {
        const render_cpu::LineLightRecord& record = job_.scene.line_lights[index];
        const LineSegment<float> world{to_vec(record.begin), to_vec(record.direction), record.length};
        const auto local = to_shading_space(world, surface_.position, surface_.frame);
        const Real end = local.p0.z + local.length * local.s.z;
        const LaneMask lit = surface_.valid & !(max(local.p0.z, end) <= Real(0));
        if (!any(lit)) return;
        const Technique<Real> technique(local);
        add(lit, static_cast<std::uint32_t>(job_.scene.polygon_light_count + index),
            to_vec(record.radiance_times_radius), [&](const Vec2<Real>& u) { return technique.sample(u.x); });
    }

    const Vector& radiance() const noexcept { return radiance_; }

private:
    template <class SampleLight>
    void add(LaneMask lit, std::uint32_t light, const Vec3<float>& emission,
             SampleLight sample_light) noexcept {
        CompensatedSum sum;
        for (std::uint32_t i = 0; i < job_.light_samples; ++i) {
            const LightSample<Real> sample =
                sample_light(random_for_light(job_, block_, first_sample_ + i, light));
            const LaneMask sampled = lit & !(sample.pdf == Real(0)) & !(sample.wi.z <= Real(0));
            const Real cos_per_pdf = sample.wi.z / select(sampled, sample.pdf, Real(1));
            const Vector reflected = cos_per_pdf * surface_.brdf.eval(sample.wi);
            const LaneMask sound = (sample.pdf > Real(0)) & is_finite(sample.pdf) & is_finite(sample.wi) &
                                   is_finite(sample.p) & is_finite(reflected);
            statistics_.rejected_samples += count_lanes(sampled & !sound);
            const Vector zero{Real(0), Real(0), Real(0)};
            sum.add(select(visible(sampled & sound, reflected, sample), reflected, zero));
        }
        const float scale = 1.0f / static_cast<float>(job_.light_samples);
        const Vec3<float> factor = scale * emission;
        radiance_ = radiance_ + Vector{Real(factor.x) * sum.sum.x, Real(factor.y) * sum.sum.y,
                                       Real(factor.z) * sum.sum.z};
    }

    /// Those lanes whose sample contributes and sees the light.
    LaneMask visible(LaneMask sampled, const Vector& reflected, const LightSample<Real>& sample) noexcept {
        const Vector to_light = surface_.frame.to_world(sample.p);
        const auto above_surface = dot(surface_.geometric_normal, to_light) > Real(0);
        const Real largest = max(max(reflected.x, reflected.y), reflected.z);
        const LaneMask needed = sampled & above_surface & (largest > Real(0));
        const std::uint32_t active = needed.bits();
        if (active == 0) return needed;

        const Vector offset = surface_.offset * surface_.geometric_normal;
        const Vector origin = surface_.position + offset;
        const Vector direction = to_light - offset;
        visibility::RayPacket<kLanes> rays;
        origin.x.store(rays.origin[0]);
        origin.y.store(rays.origin[1]);
        origin.z.store(rays.origin[2]);
        direction.x.store(rays.direction[0]);
        direction.y.store(rays.direction[1]);
        direction.z.store(rays.direction[2]);
        Real(kShadowRayEnd).store(rays.t_far);
        const visibility::PacketTracer<kLanes>& tracer = job_.tracer;
        const std::uint64_t begin = __builtin_ia32_rdtsc();
        const std::uint32_t blocked = tracer.occluded(job_.tracer.context, active, rays);
        statistics_.shadow_ticks += __builtin_ia32_rdtsc() - begin;
        statistics_.shadow_rays += count_lanes(needed);
        return LaneMask::from_bits(active & ~blocked);
    }

    /// A planar light does not light itself, but rounding may put a point of it in front of its plane.
    LaneMask is_part_of_light(std::int32_t index) const noexcept {
        std::uint32_t bits = 0;
        for (int i = 0; i < kLanes; ++i)
            bits |= static_cast<std::uint32_t>(surface_.light.lane[i] == index) << i;
        return LaneMask::from_bits(bits);
    }

    const render_cpu::RenderJob& job_;
    const PixelBlock& block_;
    const Surface& surface_;
    std::uint32_t first_sample_;
    render_cpu::TileStatistics& statistics_;
    Vector radiance_{Real(0), Real(0), Real(0)};
};

/// One of the instantiations of DirectLight::add_polygon or add_line.
using AddLight = void (DirectLight::*)(std::int32_t index) noexcept;

template <class Real, int N>
using PolygonPsa = PolygonProjectedSolidAngle<Real, N>;
template <class Real>
using LinePsa = LineProjectedSolidAngle<Real>;

template <int N>
inline AddLight polygon_function(render_cpu::Technique technique) noexcept {
    switch (technique) {
    case render_cpu::Technique::area:
        return &DirectLight::add_polygon<PolygonArea, N>;
    case render_cpu::Technique::solid_angle:
        return &DirectLight::add_polygon<PolygonSolidAngle, N>;
    case render_cpu::Technique::clipped_solid_angle:
        return &DirectLight::add_polygon<PolygonClippedSolidAngle, N>;
    case render_cpu::Technique::projected_solid_angle_biased:
        return &DirectLight::add_polygon<PolygonProjectedSolidAngleBiased, N>;
    case render_cpu::Technique::projected_solid_angle:
        break;
    }
    return &DirectLight::add_polygon<PolygonPsa, N>;
}

inline AddLight line_function(render_cpu::Technique technique) noexcept {
    switch (technique) {
    case render_cpu::Technique::area:
        return &DirectLight::add_line<LineArea>;
    case render_cpu::Technique::solid_angle:
        return &DirectLight::add_line<LineSolidAngle>;
    case render_cpu::Technique::clipped_solid_angle:
        return &DirectLight::add_line<LineClippedSolidAngle>;
    case render_cpu::Technique::projected_solid_angle:
    case render_cpu::Technique::projected_solid_angle_biased:
        break;
    }
    return &DirectLight::add_line<LinePsa>;
}

} // namespace kernel
NUSSELT_NAMESPACE_END
