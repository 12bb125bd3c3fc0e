#pragma once
/// A published method, to compare with: sampling of a rectangle around the silhouette of a cylinder.
///
/// M. N. Gamito 2016, Solid Angle Sampling of Disk and Cylinder Lights, CGF 35(4), doi:10.1111/cgf.12946. A
/// rectangle that covers the cylinder as seen from the shading point is sampled by solid angle, with the map of
/// Ureña et al. 2013; directions that miss the cylinder are no samples. C. Peters 2021, BRDF Importance Sampling
/// for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379, Sec. 5.4, names the variant that samples the rectangle by
/// projected solid angle. Use CylinderSolidAngle and CylinderProjectedSolidAngle instead: they miss nothing.
///
/// Deviations: the rectangle is the smallest one across the direction to the axis. Its long edges touch the
/// outline, so that only directions beyond the caps miss. Before a cap, that is, within the infinite cylinder, it
/// is the square around the cap, of which the disk fills pi / 4.
/// Known failures: close to the lateral surface, most directions miss a light that begins far ahead of the point. At 1.01
/// radii from the axis, with the cap ten radii ahead, one in seven hits.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/cylinder.h>
#include <nusselt/related/rectangle_polygon.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/rectangle_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN
namespace gamito {

/// The rectangle by solid angle, as in the paper.
struct SolidAngle {
    template <class Real>
    using Technique = RectangleSolidAngle<Real>;
};

/// The part of the rectangle above the horizon by projected solid angle.
struct ProjectedSolidAngle {
    template <class Real>
    using Technique = PolygonProjectedSolidAngle<Real, 4>;
};

/// A closed cylinder, prepared for rays that start at the origin outside of it.
template <class Real>
struct RayTarget {
    Vec3<Real> s, m, n; ///< orthonormal; s along the axis
    Vec2<Real> center;  ///< where the infinite axis passes, in the basis m, n
    Real squared_radius;
    Real power;  ///< squared distance of the infinite axis minus squared radius: negative within
    Real l0, l1; ///< of the caps along s

    /// Uninitialised: to be assigned to before it is used.
    RayTarget() = default;

    NUSSELT_INLINE explicit RayTarget(const CylinderView<Real>& view) noexcept
        : s(view.s),
          m(view.m),
          n(view.n),
          center(view.center),
          squared_radius(view.radius * view.radius),
          power(view.gap * view.sum),
          l0(view.l0),
          l1(view.l1) {}

    template <class Single>
    NUSSELT_HD explicit RayTarget(const RayTarget<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    struct Hit {
        mask_t<Real> hits;
        Real distance; ///< of the first point; 0 without a hit
    };
    /// \param wi unit direction.
    NUSSELT_INLINE Hit intersect(const Vec3<Real>& wi) const noexcept {
        constexpr scalar_t<Real> kLeast = kTiny<scalar_t<Real>>;
        // Intersect the ray with the infinite cylinder. A ray that misses only by rounding touches it.
        const Vec2<Real> across{dot(wi, m), dot(wi, n)};
        const Real squares = dot(across, across);
        const Real middle = dot(across, center);
        const Real offset = det(center, across);
        const Real root = sqrt(max(multiply_add(squares, squared_radius, -offset * offset), Real(0)));
        // The product of both roots is power / squares: neither comes from a difference.
        const Real larger = max(abs(middle) + root, Real(kLeast));
        const Real smaller_root = abs(power) / larger;
        const Real larger_root = larger / max(squares, Real(kLeast));
        const auto outside = power >= Real(0);
        const auto forwards = middle > Real(0);
        const Real near = select(outside, smaller_root, Real(0));
        const Real far = select(forwards, larger_root, select(outside, Real(0), smaller_root));

        // Intersect it with the slab between the caps.
        const Real along = dot(wi, s);
        const Real inverse = Real(1) / copysign(max(abs(along), Real(kLeast)), along);
        const Real to_start = inverse * l0;
        const Real to_end = inverse * l1;
        const Real enters = max(near, min(to_start, to_end));
        const Real leaves = min(far, max(to_start, to_end));
        const auto hits = (enters <= leaves) & (enters > Real(0));
        return {mask_t<Real>(hits), select(hits, enters, Real(0))};
    }

    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.s, self.m, self.n, self.center, self.squared_radius, self.power, self.l0, self.l1);
    }
};

} // namespace gamito

/// \tparam Real      float, double, long double or a pack of float or double: one light and shading point per lane,
///                   or many samples of one light (see the broadcasting constructor).
/// \tparam Rectangle gamito::SolidAngle or gamito::ProjectedSolidAngle: how the rectangle is sampled.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: the constant 1 / measure(), or wi.z /
/// measure() by projected solid angle.
/// Space: any frame with the shading point as origin, nothing is clipped; by projected solid angle, shading space,
/// clipped to the horizon.
/// Edge cases: no length or radius, origin inside, or nothing above the horizon if that matters: pdf = 0, measure
/// 0.
template <class Real, class Rectangle = gamito::SolidAngle>
class CylinderRejectionGamito {
public:
    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit CylinderRejectionGamito(const Cylinder<Real>& light) noexcept
        : CylinderRejectionGamito(to_unit_extent(light)) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit CylinderRejectionGamito(
        const CylinderRejectionGamito<Single, Rectangle>& single) noexcept
        : rectangle_(single.rectangle_), target_(single.target_), inverse_scale_(single.inverse_scale_) {}

    /// \param u in [0, 1)^2, of the rectangle.
    /// \return pdf = 0 where the direction misses the cylinder: an estimate counts it as 0.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const LightSample<Real> s = rectangle_.sample(u);
        const auto hit = target_.intersect(s.wi);
        return {s.wi, select(hit.hits, s.pdf, Real(0)), (inverse_scale_ * hit.distance) * s.wi};
    }

    /// The density of directions in the rectangle, whether they hit the cylinder or not.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept { return rectangle_.pdf(wi); }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept { return rectangle_.invert(wi); }

    /// Solid angle or projected solid angle of the rectangle [sr], which is larger than that of the light.
    NUSSELT_HD Real measure() const noexcept { return rectangle_.measure(); }

private:
    NUSSELT_HD explicit CylinderRejectionGamito(const ScaledLight<Cylinder<Real>, Real>& unit) noexcept
        : CylinderRejectionGamito(make_cylinder_view(unit.light, {Real(0), Real(0), Real(0)}),
                                  unit.inverse_scale) {}

    NUSSELT_HD CylinderRejectionGamito(const CylinderView<Real>& view, const Real& inverse_scale) noexcept
        : rectangle_(rectangle_around(view)), target_(view), inverse_scale_(inverse_scale) {}

    /// \returns a polygon of no size if nothing is visible.
    NUSSELT_HD static ConvexPolygon<Real, 4> rectangle_around(const CylinderView<Real>& v) noexcept {
        // Across the direction to the axis, where the tangents from the origin touch the cylinder.
        const Real distance = select(v.outside, v.center.x, Real(1));
        const Real ratio = v.radius / distance;
        const Real depth = v.gap * (v.sum / distance);
        const Real half_width = ratio * sqrt(max(v.gap, Real(0))) * sqrt(v.sum);
        const Real low = v.l0 * select(v.l0 < Real(0), Real(1) + ratio, Real(1) - ratio);
        const Real high = v.l1 * select(v.l1 > Real(0), Real(1) + ratio, Real(1) - ratio);
        const Vec3<Real> beside = depth * v.m + low * v.s;
        // The square around the nearer cap.
        const Vec3<Real> cap = select(v.l0 > Real(0), v.start, v.end);

        const Real size = select(v.visible, Real(1), Real(0));
        const Real half = size * select(v.outside, half_width, v.radius);
        const Vec3<Real> corner =
            select(v.outside, beside, cap - v.radius * v.m) - select(v.outside, half_width, v.radius) * v.n;
        const Vec3<Real> first = size * select(v.outside, (high - low) * v.s, (Real(2) * v.radius) * v.m);
        return rectangle_polygon(size * corner, first, (Real(2) * half) * v.n,
                                 size * select(v.outside, -v.m, v.s));
    }

    typename Rectangle::template Technique<Real> rectangle_; ///< of the cylinder with an extent of order one
    gamito::RayTarget<Real> target_;
    Real inverse_scale_;

    template <class, class>
    friend class CylinderRejectionGamito;
};

/// With the rectangle sampled by projected solid angle.
template <class Real>
using CylinderProjectedRejectionGamito = CylinderRejectionGamito<Real, gamito::ProjectedSolidAngle>;

NUSSELT_NAMESPACE_END
