#pragma once
/// A published method, to compare with: sampling of a rectangle around the silhouette of a cylinder.
///
/// M. N. Gamito 2016, Solid Angle Sampling of Disk and Cylinder Lights, CGF 35(4), doi:10.1111/cgf.12946. A rectangle
/// that covers the cylinder as seen from the shading point is sampled by solid angle; directions that miss the cylinder
/// are no samples. Use CylinderSolidAngle instead: it misses nothing. The rectangle is the smallest one across the
/// direction to the axis; before a cap it is the square around the cap. It is sampled as two triangles where the paper uses
/// a map for rectangles, with the same density.

#include <nusselt/geometry/cylinder.h>
#include <nusselt/related/polygon_solid_angle_peters.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double or long double.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure().
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no length or radius, or origin inside: pdf = 0, measure 0.
template <class Real>
class CylinderRejectionGamito {
public:
    /// \param light relative to the shading point [m].
    explicit CylinderRejectionGamito(const Cylinder<Real>& light) noexcept
        : light_(light), rectangle_(rectangle_around(light)), visible_(rectangle_.measure() > Real(0)) {}

    /// \param u in [0, 1)^2.
    /// \return pdf = 0 where the direction misses the cylinder: an estimate counts it as 0.
    LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec3<Real> up{Real(0), Real(0), Real(1)};
        const Vec3<Real> wi = visible_ ? rectangle_.sample(u).wi : up;
        const LightHit<Real> hit = intersect(light_, wi);
        return {wi, hit.hits ? pdf(wi) : Real(0), hit.distance * wi};
    }

    /// The density of directions in the rectangle, whether they hit the cylinder or not.
    Real pdf(const Vec3<Real>&) const noexcept { return visible_ ? Real(1) / rectangle_.measure() : Real(0); }

    /// Solid angle of the rectangle [sr].
    Real measure() const noexcept { return visible_ ? rectangle_.measure() : Real(0); }

private:
    static PolygonSolidAnglePeters<Real, 4> rectangle_around(const Cylinder<Real>& light) noexcept {
        const auto unit = to_unit_extent(light);
        const CylinderView<Real> v = make_cylinder_view(unit.light, {Real(0), Real(0), Real(0)});
        const Vec3<Real>& t = v.m;
        // Across the direction to the axis, where the tangents from the origin touch the cylinder.
        const Real distance = select(v.outside, v.center.x, Real(1));
        const Real ratio = v.radius / distance;
        const Real depth = v.gap * (v.sum / distance);
        const Real half_width = ratio * sqrt(max(v.gap, Real(0))) * sqrt(v.sum);
        const Real low = v.l0 * select(v.l0 < Real(0), Real(1) + ratio, Real(1) - ratio);
        const Real high = v.l1 * select(v.l1 > Real(0), Real(1) + ratio, Real(1) - ratio);
        // The square around the nearer cap.
        const Vec3<Real> cap = select(v.l0 > Real(0), v.start, v.end);

        const Vec3<Real> center = select(v.outside, depth * t + (Real(0.5) * (low + high)) * v.s, cap);
        const Vec3<Real> a = select(v.outside, (Real(0.5) * (high - low)) * v.s, v.radius * t);
        const Vec3<Real> b = select(v.outside, half_width, v.radius) * v.n;
        const Real size = select(v.visible, unit.inverse_scale, Real(0));
        const Vec3<Real> corners[] = {size * (center - a - b), size * (center + a - b),
                                      size * (center + a + b), size * (center - a + b)};
        return PolygonSolidAnglePeters<Real, 4>(make_polygon<4>(corners, 4));
    }

    Cylinder<Real> light_;
    PolygonSolidAnglePeters<Real, 4> rectangle_;
    bool visible_;
};

NUSSELT_NAMESPACE_END
