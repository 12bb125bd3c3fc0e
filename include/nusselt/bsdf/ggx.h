#pragma once
/// Functions that BRDFs and samplers with GGX normals share (B. Walter et al. 2007, Microfacet Models for Refraction
/// through Rough Surfaces, doi:10.2312/EGWR/EGSR07/195-206, Eq. 33).

#include <nusselt/core/trig.h>
#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// Smallest GGX alpha. Rounding turns a half vector of float directions by about 6e-8: lobes must be much
/// wider for their values to mean something, and the peak 1 / (pi alpha^2) stays far from overflow.
inline constexpr double kSmallestGgxAlpha = 1e-4;

/// The alpha of GGX: the square of the roughness, but at least kSmallestGgxAlpha.
/// \param roughness perceptual ("linear") roughness, clamped to [0, 1]; NaN counts as 0.
template <class Real>
NUSSELT_INLINE Real ggx_alpha(const Real& roughness) noexcept {
    const Real clamped = min(max(roughness, Real(0)), Real(1));
    return max(clamped * clamped, Real(scalar_t<Real>(kSmallestGgxAlpha)));
}

/// |h|^2 / (h.x^2 + h.y^2 + alpha^2 h.z^2), from which the density of normals follows. The textbook's
/// (n.h)^2 (alpha^2 - 1) + 1 cancels in narrow lobes; this is a quotient of sums of positive terms.
/// \param h half vector in shading space of any length but 0, such as wo + wi.
template <class Real>
NUSSELT_INLINE Real ggx_ratio(const Vec3<Real>& h, const Real& alpha2) noexcept {
    // The scaled vector has a length near one even if the directions almost oppose each other.
    const Vec3<Real> scaled = reciprocal_power_of_two(max(max(abs(h.x), abs(h.y)), abs(h.z))) * h;
    const Real plane2 = scaled.x * scaled.x + scaled.y * scaled.y;
    const Real height2 = scaled.z * scaled.z;
    return (plane2 + height2) / (plane2 + alpha2 * height2);
}

/// Density D of normals: its integral times the cosine is 1 [1/sr].
/// \param ratio ggx_ratio() of the half vector.
template <class Real>
NUSSELT_INLINE Real ggx_distribution(const Real& ratio, const Real& alpha2) noexcept {
    return alpha2 * ratio * ratio * Real(1 / kPi<scalar_t<Real>>);
}

NUSSELT_NAMESPACE_END
