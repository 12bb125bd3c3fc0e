#pragma once
/// Polygons of records, and their techniques.

#include "render_cpu/kernel/analytic.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/single_technique.h"

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/ltc/polygon_shading.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// In world space. \param corners N vertices and then N edges
template <int N>
ConvexPolygon<float, N> stored_polygon(const scene::Float3* corners, const scene::Float3& normal) noexcept {
    ConvexPolygon<float, N> world;
    for (int j = 0; j < N; ++j) {
        world.vertex[j] = to_vec(corners[j]);
        world.edge[j] = to_vec(corners[N + j]);
    }
    world.normal = to_vec(normal);
    return world;
}

/// The largest z of all vertices.
template <int N>
Real highest_vertex(const ConvexPolygon<Real, N>& polygon) noexcept {
    Real highest = polygon.vertex[0].z;
    for (int j = 1; j < N; ++j) highest = max(highest, polygon.vertex[j].z);
    return highest;
}

/// What kinds of light with the shape of a polygon share, see point_samples.h.
template <int N>
struct PolygonTechniques {
    using Polygon = ConvexPolygon<Real, N>;
    using Technique = render::Technique;

    static auto technique(TechniqueTag<Technique::area>, const Polygon& shape) noexcept {
        return PolygonArea<Real, N>(shape);
    }
    static auto technique(TechniqueTag<Technique::solid_angle>, const Polygon& shape) noexcept {
        return PolygonSolidAngle<Real, N>(shape);
    }
    static auto technique(TechniqueTag<Technique::clipped_solid_angle>, const Polygon& shape) noexcept {
        return PolygonClippedSolidAngle<Real, N>(shape);
    }
    static auto technique(TechniqueTag<Technique::projected_solid_angle>, const Polygon& shape) noexcept {
        return PolygonProjectedSolidAngle<Real, N>(shape);
    }
    static auto technique(TechniqueTag<Technique::projected_solid_angle_biased>,
                          const Polygon& shape) noexcept {
        return PolygonProjectedSolidAngleBiased<Real, N>(shape);
    }

    static LobeIntegrals integrals(const Polygon& shape, const Ltc<Real>& lobe) noexcept {
        return {diffuse_integral(shape), lobe_integral<BothHorizons>(shape, lobe)};
    }
};

} // namespace kernel
NUSSELT_NAMESPACE_END
