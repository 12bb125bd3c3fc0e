#pragma once
/// Analytic, unshadowed shading with spheres, disks, ellipses and ellipsoids, with the horizon.
///
/// Above the horizon it is the form of E. Heitz and S. Hill 2017, Linear-Light Shading with Linearly Transformed
/// Cosines. Where the horizon cuts the image, quadrature with 16 nodes along the rim is exact up to rounding for
/// ordinary lights, and needs no table of form factors (cone_sweep.h has its errors).
///
/// Integrals of normalised lobes: times the albedo of the lobe and the radiance of the light they are radiance.

#include <nusselt/cones/cosine_cone.h>
#include <nusselt/cones/round_lights.h>
#include <nusselt/ltc/ltc.h>

NUSSELT_NAMESPACE_BEGIN

/// Integral of the clamped cosine over an elliptic cone [sr].
template <class Real>
NUSSELT_HD inline Real projected_solid_angle(const EllipticCone<Real>& cone) noexcept {
    return CosineCone<Real, 0, kConePlaces>(cone).measure();
}

/// Integral of the Lambertian lobe over the part of a light above the surface, in [0, 1].
/// \param light in shading space [m].
template <class Real, template <class> class Light>
NUSSELT_HD inline Real round_diffuse_integral(const Light<Real>& light) noexcept {
    const auto view = view_of(light, detail::SameSpace());
    return min(Real(1 / kPi<scalar_t<Real>>) * projected_solid_angle(view.cone), Real(1));
}

/// Integral of a lobe over a light, in [0, 1].
/// \param light in shading space with wo in the xz half-plane [m].
template <class Real, template <class> class Light>
NUSSELT_HD inline Real round_lobe_integral(const Light<Real>& light, const Ltc<Real>& ltc) noexcept {
    const auto view = view_of(light, [&](const Vec3<Real>& v) { return ltc.to_cosine(v); });
    return min(Real(1 / kPi<scalar_t<Real>>) * projected_solid_angle(view.cone), Real(1));
}

NUSSELT_NAMESPACE_END
