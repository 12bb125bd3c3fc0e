#pragma once
/// A published method, to compare with: sampling of a rectangle around the silhouette of a disk.
///
/// M. N. Gamito 2016, Solid Angle Sampling of Disk and Cylinder Lights, CGF 35(4), doi:10.1111/cgf.12946. A rectangle that covers
/// the disk as seen from the shading point is sampled by solid angle, with the map of Ureña et al. 2013; directions that miss the
/// disk are no samples. By projected solid angle, the same rectangle loses nothing but what misses the disk.
///
/// Deviations: the rectangle is across the axis of the elliptic cone, with edges along its principal axes: it is the smallest one
/// there, and serves spheres and ellipsoids too.
/// Known failures: at least 21 % of the samples miss. Seen from inside a light or on it, there is no rectangle.

#include <nusselt/cones/round_lights.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/related/cylinder_rejection_gamito.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real      float, double, long double or a pack of float or double: one light and shading point per lane, or many
///                   samples of one light (see the broadcasting constructor).
/// \tparam Light     Sphere, Disk, Ellipse or Ellipsoid.
/// \tparam Rectangle gamito::SolidAngle or gamito::ProjectedSolidAngle: how the rectangle is sampled.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: the constant 1 / measure(), or wi.z / measure() by projected
/// solid angle.
/// Space: any frame with the shading point as origin, nothing is clipped; by projected solid angle, shading space, clipped to the
/// horizon.
/// Edge cases: no extent, the origin inside or in the plane of a disk: pdf = 0, measure 0.
template <class Real, template <class> class Light, class Rectangle = gamito::SolidAngle>
class ConeRejectionGamito {
public:
    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit ConeRejectionGamito(const Light<Real>& light) noexcept
        : view_(view_of(light, detail::SameSpace())), rectangle_(rectangle_around(view_)) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit ConeRejectionGamito(
        const ConeRejectionGamito<Single, Light, Rectangle>& single) noexcept
        : view_(broadcast<Real>(single.view_)), rectangle_(single.rectangle_) {}

    /// \param u in [0, 1)^2, of the rectangle.
    /// \return pdf = 0 where the direction misses the light: an estimate counts it as 0.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const LightSample<Real> s = rectangle_.sample(u);
        const EllipticCone<Real>& cone = view_.cone;
        const Real ahead = dot(s.wi, cone.e3) * (Real(1) / max(cone.c, Real(kFlat)));
        const Vec2<Real> disk{detail::over_positive(dot(s.wi, cone.e1), ahead * cone.a),
                              detail::over_positive(dot(s.wi, cone.e2), ahead * cone.b)};
        const auto within = dot(disk, disk) <= Real(1);
        const auto exists = rectangle_.measure() > Real(0);
        const auto hits = within & exists;
        const Real distance = max(dot(s.wi, view_.point(disk, s.wi)), Real(0));
        return {s.wi, select(hits, s.pdf, Real(0)), (view_.inverse_scale * distance) * s.wi};
    }

    /// The density of directions in the rectangle, whether they hit the light or not.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept { return rectangle_.pdf(wi); }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept { return rectangle_.invert(wi); }

    /// Solid angle or projected solid angle of the rectangle [sr], which is larger than that of the light.
    NUSSELT_HD Real measure() const noexcept { return rectangle_.measure(); }

private:
    /// Cones with a half-angle whose cotangent is less are half-spaces.
    static constexpr scalar_t<Real> kFlat = 16 * std::numeric_limits<scalar_t<Real>>::epsilon();

    NUSSELT_HD static ConvexPolygon<Real, 4> rectangle_around(const LightView<Light<Real>>& view) noexcept {
        const EllipticCone<Real>& cone = view.cone;
        const auto seen = cone.is_visible & !view.is_open() & (cone.c > Real(kFlat));
        const Real size = select(seen, Real(1), Real(0));
        const Vec3<Real> across = (size * cone.a) * cone.e1, along = (size * cone.b) * cone.e2;
        return rectangle_polygon((size * cone.c) * cone.e3 - across - along, Real(2) * across,
                                 Real(2) * along, cone.e3);
    }

    LightView<Light<Real>> view_;
    typename Rectangle::template Technique<Real> rectangle_;

    template <class, template <class> class, class>
    friend class ConeRejectionGamito;
};

/// With the rectangle sampled by projected solid angle.
template <class Real, template <class> class Light>
using ConeProjectedRejectionGamito = ConeRejectionGamito<Real, Light, gamito::ProjectedSolidAngle>;

/// \name Both for disks.
/// @{
template <class Real>
using DiskRejectionGamito = ConeRejectionGamito<Real, Disk>;
template <class Real>
using DiskProjectedRejectionGamito = ConeProjectedRejectionGamito<Real, Disk>;
/// @}

NUSSELT_NAMESPACE_END
