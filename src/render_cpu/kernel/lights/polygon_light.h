#pragma once
/// Polygonal lights with room for N vertices.

#include "render_cpu/kernel/analytic.h"
#include "render_cpu/kernel/reflected_light.h"
#include "render_cpu/kernel/single_technique.h"
#include "render_cpu/lights/polygon_records.h"

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/ltc/polygon_shading.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

inline const render_cpu::PolygonRecord& polygon_record(const render_cpu::LightSet& lights,
                                                       std::int32_t index) noexcept {
    return static_cast<const render_cpu::PolygonRecords*>(lights.records)->lights[index];
}

/// A kind of light as point_samples.h describes it.
template <int N>
struct PolygonLight {
    using Shape = ConvexPolygon<Real, N>;
    using Technique = render::Technique;

    /// In world space.
    static ConvexPolygon<float, N> world(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
        const auto& records = *static_cast<const render_cpu::PolygonRecords*>(lights.records);
        const render_cpu::PolygonRecord& record = records.lights[index];
        const scene::Float3* corners = records.corners + record.first_corner;
        ConvexPolygon<float, N> world;
        for (int j = 0; j < N; ++j) {
            world.vertex[j] = to_vec(corners[j]);
            world.edge[j] = to_vec(corners[N + j]);
        }
        world.normal = to_vec(record.normal);
        return world;
    }

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const render_cpu::PolygonRecord& record = polygon_record(lights, index);
        const Surface& surface = reflected.surface();
        const auto local = to_shading_space(world(lights, index), surface.position, surface.frame);

        const std::int32_t number = lights.first + index;
        // A planar light does not light itself, but rounding may put a point of it in front of its plane.
        LaneMask lit = reflected.lanes() & !reflected.on_light(number);
        // Comparisons with NaN are false. Negated, they keep NaN, so that it is counted.
        if (record.two_sided == 0) lit &= !(dot(local.normal, local.vertex[0]) >= Real(0));
        Real highest = local.vertex[0].z;
        for (int j = 1; j < N; ++j) highest = max(highest, local.vertex[j].z);
        lit &= !(highest <= Real(0));
        return {local, lit, broadcast<Real>(to_vec(record.radiance)), static_cast<std::uint32_t>(number)};
    }

    static auto technique(TechniqueTag<Technique::area>, const Shape& shape) noexcept {
        return PolygonArea<Real, N>(shape);
    }
    static auto technique(TechniqueTag<Technique::solid_angle>, const Shape& shape) noexcept {
        return PolygonSolidAngle<Real, N>(shape);
    }
    static auto technique(TechniqueTag<Technique::clipped_solid_angle>, const Shape& shape) noexcept {
        return PolygonClippedSolidAngle<Real, N>(shape);
    }
    static auto technique(TechniqueTag<Technique::projected_solid_angle>, const Shape& shape) noexcept {
        return PolygonProjectedSolidAngle<Real, N>(shape);
    }
    static auto technique(TechniqueTag<Technique::projected_solid_angle_biased>,
                          const Shape& shape) noexcept {
        return PolygonProjectedSolidAngleBiased<Real, N>(shape);
    }

    static LobeIntegrals integrals(const Shape& shape, const Ltc<Real>& lobe) noexcept {
        return {diffuse_integral(shape), lobe_integral<BothHorizons>(shape, lobe)};
    }
};

/// The function that takes points of polygons as a job demands.
template <int N>
render_cpu::AddLight polygon_points(const render_cpu::RenderJob& job) noexcept;
/// The function that takes lines in place of points.
template <int N>
render_cpu::AddLight polygon_lines() noexcept;

template <>
render_cpu::AddLight polygon_points<4>(const render_cpu::RenderJob& job) noexcept;
template <>
render_cpu::AddLight polygon_points<8>(const render_cpu::RenderJob& job) noexcept;
template <>
render_cpu::AddLight polygon_lines<4>() noexcept;
template <>
render_cpu::AddLight polygon_lines<8>() noexcept;

} // namespace kernel
NUSSELT_NAMESPACE_END
