#pragma once
/// The backward error of a sample: the change of the random number that would explain it.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, Sec. 3.4, and BRDF Importance Sampling for
/// Polygonal Lights, Sec. 3.6. An error of a direction is not conclusive where directions are dense; an error of
/// the random number is directly comparable to the spacing of random numbers.

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// Backward error of a technique for lines.
/// \param u  the random number that was given to sample().
/// \param wi the direction that sample() returned.
/// \return |invert(wi) - u| with the precision of invert() in Real: use long double to judge a method, the
///         type of the renderer to judge rounding. Without meaning where the sample has pdf = 0.
template <class Technique, class Real>
NUSSELT_HD inline Real backward_error(const Technique& technique, const Real& u,
                                      const Vec3<Real>& wi) noexcept {
    return abs(technique.invert(wi) - u);
}

/// Backward error of a technique for polygons: of the first random number, the azimuth, which is what the
/// projected solid angle technique iterates for; the second one follows in closed form. Relative to the whole
/// light, where the papers use the sector that the sample falls into. Where the zenith lies in the light,
/// azimuths are cyclic and rounding may exchange 0 for almost 1.
template <class Technique, class Real>
NUSSELT_HD inline Real backward_error(const Technique& technique, const Vec2<Real>& u,
                                      const Vec3<Real>& wi) noexcept {
    return abs(technique.invert(wi).x - u.x);
}

NUSSELT_NAMESPACE_END
