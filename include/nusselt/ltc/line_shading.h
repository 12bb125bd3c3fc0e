#pragma once
/// Analytic, unshadowed shading with linear lights, and tubes and strips approximated by them.
///
/// E. Heitz, S. Hill 2017, Linear-Light Shading with Linearly Transformed Cosines, GPU Zen. Deviations: integrals by end
/// points (clip_line.h) instead of antiderivatives; the factor of strips (strip.h).
///
/// Integrals of normalised lobes: times the albedo of the lobe and the radiance of the light they are radiance.

#include <nusselt/geometry/strip.h>
#include <nusselt/ltc/light_transform.h>

NUSSELT_NAMESPACE_BEGIN

/// Integral of the Lambertian lobe over the part of a linear light above the surface, per radius [1/m].
/// \param light in shading space [m].
template <class Real>
NUSSELT_HD inline Real diffuse_integral(const LineSegment<Real>& light) noexcept {
    return Real(1 / kPi<scalar_t<Real>>) * projected_solid_angle(light);
}

/// Integral of a lobe over a linear light, per radius [1/m]; 0 without length or where its line meets the origin.
/// \tparam Horizons CosineHorizon, or BothHorizons where light below the surface shall not count.
/// \param light in shading space with wo in the xz half-plane [m].
template <class Horizons = CosineHorizon, class Real>
NUSSELT_HD inline Real lobe_integral(const LineSegment<Real>& light, const Ltc<Real>& ltc) noexcept {
    const auto unit = to_unit_extent(light);
    const LineSegment<Real> part = Horizons::part_of(unit.light);
    const Real ratio = radius_ratio(cross(part.p0, part.s), ltc);
    const auto seen = ratio > Real(0);
    const Real integral =
        diffuse_integral(to_cosine_space(part, ltc)) / select(seen, ratio, Real(1)) * unit.scale;
    return select(seen, integral, Real(0));
}

/// A tube of small radius instead of an infinitely thin one, without its end caps. A lobe has no more to give than 1.
/// \param line_integral of a lobe over the axis of the tube, per radius [1/m].
/// \param radius        [m]
/// \returns integral of the lobe over the tube, in [0, 1]. The error is of the order of radius over distance.
template <class Real>
NUSSELT_HD inline Real tube_integral(const Real& line_integral, const Real& radius) noexcept {
    return min(line_integral * radius, Real(1));
}

/// The same with end caps.
/// \param caps caps_integral() of the lobe.
template <class Real>
NUSSELT_HD inline Real tube_integral(const Real& line_integral, const Real& radius,
                                     const Real& caps) noexcept {
    return min(fma(line_integral, radius, caps), Real(1));
}

/// The end caps of a tube as small disks, for tube_integral(). Heitz and Hill advise against it by default: bright
/// spots show where a lobe is narrower than the tube.
/// \param light   the axis, in shading space [m].
/// \param radius  [m]
/// \param density of a lobe [1/sr], a function of a unit direction.
template <class Real, class Density>
NUSSELT_HD inline Real caps_integral(const LineSegment<Real>& light, const Real& radius,
                                     const Density& density) noexcept {
    const auto disk = [&](const Vec3<Real>& p, const Vec3<Real>& inward) {
        const Vec3<Real> wi = normalize(p);
        const Real distance = length(p);
        const Real ratio = radius / select(distance > Real(0), distance, Real(1));
        const Real cosine = max(dot(wi, inward), Real(0));
        return select(distance > Real(0), density(wi) * cosine * ratio * ratio, Real(0));
    };
    return Real(kPi<scalar_t<Real>>) * (disk(light.p0, light.s) + disk(end_of(light), -light.s));
}

/// A narrow strip instead of a thin tube: it looks the thinner the more it turns its edge to the point.
/// \param light         the middle line, in shading space [m].
/// \param normal        of the strip, unit, perpendicular to the line; both sides shine.
/// \param width         of the strip [m].
/// \param line_integral of a lobe over the line, per radius [1/m].
/// \returns integral of the lobe over the strip, in [0, 1]. The error is of the order of width over distance.
template <class Real>
NUSSELT_HD inline Real strip_integral(const LineSegment<Real>& light, const Vec3<Real>& normal,
                                      const Real& width, const Real& line_integral) noexcept {
    return tube_integral(line_integral * strip_facing(light, normal), Real(0.5) * width);
}

NUSSELT_NAMESPACE_END
