#pragma once
/// Analytic, unshadowed shading with polygonal lights: E. Heitz, J. Dupuy, S. Hill, D. Neubelt 2016, Real-Time
/// Polygonal-Light Shading with Linearly Transformed Cosines, doi:10.1145/2897824.2925895, with exact clipping.
///
/// Integrals of normalised lobes: times the albedo of the lobe and the radiance of the light they are radiance.

#include <nusselt/ltc/light_transform.h>

NUSSELT_NAMESPACE_BEGIN

/// Integral of the Lambertian lobe over the part of a polygon above the surface, in [0, 1].
/// \param light in shading space, either winding [m].
template <class Real, int N>
NUSSELT_HD inline Real diffuse_integral(const ConvexPolygon<Real, N>& light) noexcept {
    return Real(1 / kPi<scalar_t<Real>>) * projected_solid_angle(light);
}

/// Integral of a lobe over a polygon, in [0, 1]; 0 if the polygon has no area.
/// \tparam Horizons CosineHorizon, or BothHorizons where light below the surface shall not count.
/// \param light in shading space with wo in the xz half-plane, either winding [m].
/// Accuracy: a few rounding errors of 1 in absolute terms. PolygonLtc::measure() is the same number, accurate relative
/// to itself, at three times the cost.
template <class Horizons = CosineHorizon, class Real, int N>
NUSSELT_HD inline Real lobe_integral(const ConvexPolygon<Real, N>& light, const Ltc<Real>& ltc) noexcept {
    return diffuse_integral(to_cosine_space(Horizons::outline_of(light), ltc));
}

NUSSELT_NAMESPACE_END
