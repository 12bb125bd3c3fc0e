#pragma once
/// BRDF sampling of a convex polygon: directions by the BRDF alone, and a test whether they hit the light. Good for
/// lights that fill much of a narrow lobe; otherwise most samples miss. As a partner in multiple importance sampling it
/// covers the peaks that sampling of the light misses.
///
/// docs/techniques/ggx_visible_normals.md explains why lines have no such technique.

#include <nusselt/bsdf/ggx_visible_normals.h>
#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/polygon_hull.h>
#include <nusselt/geometry/polygon_part.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double: one light and shading point per lane, or many
///              samples of one light (see the broadcasting constructor).
/// \tparam N    bound on the number of vertices, 3 to 8.
/// \tparam Lobe a density of directions of the same Real, with sample(u), pdf(wi) and invert(wi): GgxVisibleNormals<Real>
///              or GgxBoundedVisibleNormals<Real>.
///
/// Measure: pdf is the density of the lobe [1/sr]. Over the light it integrates to the share of samples that hit.
/// Space: shading space; no clipping, so that wi may point below the horizon.
/// Edge cases: no area, or origin in the plane of the polygon: pdf = 0.
template <class Real, int N, class Lobe>
class PolygonBrdf {
public:
    /// \param light in shading space, either winding [m].
    NUSSELT_HD PolygonBrdf(const ConvexPolygon<Real, N>& light, const Lobe& lobe) noexcept
        : PolygonBrdf(whole_part(light), lobe) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single, class SingleLobe>
    NUSSELT_HD explicit PolygonBrdf(const PolygonBrdf<Single, N, SingleLobe>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2, as for the lobe.
    /// \returns pdf = 0 where the direction misses the light.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec3<Real> wi = lobe_.sample(u);
        const Real density = select(is_towards_light(wi), pdf(wi), Real(0));
        const Vec3<Real> p = hull_.plane.distance_along(wi) * wi;
        return {wi, density, inverse_scale_ * hull_.moved_to_plane(p)};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept { return present_ * lobe_.pdf(wi); }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept { return lobe_.invert(wi); }

private:
    NUSSELT_HD PolygonBrdf(const PolygonPart<Real, N>& whole, const Lobe& lobe) noexcept
        : lobe_(lobe),
          hull_(hull_of(whole.polygon, whole.plane_distance)),
          inverse_scale_(whole.inverse_scale),
          present_(select(hull_.plane.distance != Real(0), Real(1), Real(0))) {
        const Real sign = copysign(Real(1), hull_.plane.distance);
        NUSSELT_UNROLL
        for (int j = 0; j < N; ++j) side_[j] = sign * cross(whole.polygon.vertex[j], whole.polygon.edge[j]);
    }

    NUSSELT_HD mask_t<Real> is_towards_light(const Vec3<Real>& wi) const noexcept {
        auto inside = dot(hull_.plane.normal, wi) * hull_.plane.distance > Real(0);
        NUSSELT_UNROLL
        for (int j = 0; j < N; ++j) inside = inside & (dot(side_[j], wi) >= Real(0));
        return inside;
    }

    Lobe lobe_;
    // All of this is that of the light scaled to an extent of order one.
    PolygonHull<Real> hull_;
    Vec3<Real> side_[N]; ///< normals of the planes through the origin and the edges, towards the light
    Real inverse_scale_; ///< a power of two
    Real present_;       ///< 1, or 0 if nothing of the light can be seen

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.lobe_, self.hull_, self.side_, self.inverse_scale_, self.present_);
    }
};

NUSSELT_NAMESPACE_END
