#pragma once
/// Uniform sampling of the area of a convex polygon. It needs no trigonometry and works for lights of any
/// size and distance, but is noisy wherever the solid angle per area varies, above all close to the light.
///
/// G. Turk 1992, Generating Random Points in Triangles, Graphics Gems I, for each triangle of a fan.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double, one light and shading point per
///              lane.
/// \tparam N    bound on the number of vertices, 3 to 8.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], |p|^2 / (area cos_light).
/// Space: any frame with the shading point as origin; no clipping, so that wi may point below the horizon.
/// Edge cases: no area, or origin in the plane of the polygon: pdf = 0.
template <class Real, int N>
class PolygonArea {
    static constexpr int kTriangles = N - 2;

public:
    /// \param light relative to the shading point, either winding [m].
    NUSSELT_HD explicit PolygonArea(const ConvexPolygon<Real, N>& light) noexcept {
        plane_.normal = light.normal;
        plane_.distance = plane_distance(light);
        plane_.farthest = length(light.vertex[0]);
        corner_ = light.vertex[0];
        Vec3<Real> offset = light.edge[0];
        doubled_total_ = Real(0);
        for (int j = 0; j < kTriangles; ++j) {
            plane_.farthest =
                max(plane_.farthest, max(length(light.vertex[j + 1]), length(light.vertex[j + 2])));
            side_[j] = offset;
            doubled_area_[j] = max(dot(light.normal, cross(offset, light.edge[j + 1])), Real(0));
            doubled_total_ = doubled_total_ + doubled_area_[j];
            offset = offset + light.edge[j + 1];
        }
        side_[kTriangles] = offset;
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit PolygonArea(const PolygonArea<Single, N>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; x selects the triangle of the fan around vertex 0 and the line through its first
    ///          corner, y the point on that line. Continuous within each triangle.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        // Choose a triangle of the fan in proportion to its area.
        const Real target = u.x * doubled_total_;
        Vec3<Real> a = side_[0];
        Vec3<Real> b = side_[1];
        Real before = Real(0);
        Real begin = Real(0);
        Real chosen = doubled_area_[0];
        for (int j = 0; j < kTriangles; ++j) {
            const auto reached = (doubled_area_[j] > Real(0)) & (target >= before);
            a = select(reached, side_[j], a);
            b = select(reached, side_[j + 1], b);
            chosen = select(reached, doubled_area_[j], chosen);
            begin = select(reached, before, begin);
            before = before + doubled_area_[j];
        }

        // Choose a point in it (Turk 1992): distances from the common corner go with the root.
        const Real fraction = (target - begin) / select(chosen > Real(0), chosen, Real(1));
        const Real along = min(max(fraction, Real(0)), Real(1));
        const Real root = sqrt(u.y);
        const Vec3<Real> p = corner_ + (root * (Real(1) - along)) * a + (root * along) * b;
        const Vec3<Real> wi = normalize(p);
        return {wi, density(wi, length(p)), p};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        return density(wi, plane_.distance_along(wi));
    }

    /// The random numbers for which sample() returns wi, a direction on the light; (0, 0) at vertex 0.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> q = plane_.distance_along(wi) * wi - corner_;
        const Vec3<Real>& n = plane_.normal;
        auto found = doubled_total_ <= Real(0);
        Real before = Real(0);
        Real area = Real(0);
        Real height = Real(0);
        for (int j = 0; j < kTriangles; ++j) {
            const Vec3<Real>& a = side_[j];
            const Vec3<Real>& b = side_[j + 1];
            const Real beyond_b = dot(n, cross(q, b));
            const auto usable = doubled_area_[j] > Real(0);
            // The last triangle also has what rounding moved beyond its end.
            const auto here = (!found) & usable;
            const Real inverse = Real(1) / select(usable, doubled_area_[j], Real(1));
            // Barycentric coordinates of q: of b from the triangle (a, q), of a from (q, b).
            const Real along_b = max(dot(n, cross(a, q)) * inverse, Real(0));
            const Real along_a = max(beyond_b * inverse, Real(0));
            const Real sum = along_a + along_b;
            const Real share = along_b / select(sum > Real(0), sum, Real(1));
            area = select(here, before + share * doubled_area_[j], area);
            height = select(here, sum * sum, height);
            before = before + doubled_area_[j];
            found = found | (here & (beyond_b > Real(0)));
        }
        const Real total = select(doubled_total_ > Real(0), doubled_total_, Real(1));
        return {below_one(area / total), below_one(height)};
    }

    /// Area of the light [m^2].
    NUSSELT_HD Real measure() const noexcept { return Real(0.5) * doubled_total_; }

private:
    NUSSELT_HD Real density(const Vec3<Real>& wi, const Real& distance) const noexcept {
        const Real projected = measure() * abs(dot(plane_.normal, wi));
        return select(plane_.distance != Real(0), detail::area_density(distance, projected), Real(0));
    }

    LightPlane<Real> plane_;
    Vec3<Real> corner_;               ///< vertex 0
    Vec3<Real> side_[kTriangles + 1]; ///< from the corner to the other vertices
    Real doubled_area_[kTriangles];   ///< of the triangle between sides j and j + 1
    Real doubled_total_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.plane_, self.corner_, self.side_, self.doubled_area_, self.doubled_total_);
    }
};

NUSSELT_NAMESPACE_END
