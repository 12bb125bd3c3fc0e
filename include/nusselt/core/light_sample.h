#pragma once
/// Samples, as all techniques return them, and hit points on planar lights.

#include <limits>
#include <type_traits>

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// A direction towards a light, in the frame in which the light was given.
template <class Real>
struct LightSample {
    Vec3<Real> wi; ///< unit direction from the shading point to the light
    Real pdf; ///< density of wi; positive and finite, or exactly 0: no sample, wi and p are then meaningless
    Vec3<Real> p; ///< the point on the light [m], relative to the shading point; the shadow ray leads there
};

namespace detail {

/// The density of wi for a point that is uniform on the area of a light: distance^2 / projected [1/sr].
///
/// \param distance  of the point from the origin [m].
/// \param projected area of the light times the cosine at the point [m^2].
/// \returns no more than the largest number. Where the density of a tiny light overflows, sample() and pdf() could
///           otherwise round to different sides of that limit, so that one returns a sample and the other none. 0 if
///           distance is infinite or projected is not positive.
template <class Real>
NUSSELT_HD inline Real area_density(const Real& distance, const Real& projected) noexcept {
    const Real largest = Real(std::numeric_limits<scalar_t<Real>>::max());
    const auto lit = (projected > Real(0)) & (distance > Real(0)) & (distance <= largest);
    // Divided in two steps, so that small lights far away do not overflow halfway.
    return select(lit, min(distance / select(lit, projected, Real(1)) * distance, largest), Real(0));
}

} // namespace detail

/// A sample of a technique. Those for linear lights use u.x only.
template <class Technique, class Real>
NUSSELT_HD inline LightSample<Real> draw(const Technique& technique, const Vec2<Real>& u) noexcept {
    if constexpr (std::is_invocable_v<decltype(&Technique::sample), const Technique&, const Real&>)
        return technique.sample(u.x);
    else
        return technique.sample(u);
}

/// The plane of a polygonal light as seen from the origin.
template <class Real>
struct LightPlane {
    Vec3<Real> normal; ///< unit, either side
    Real distance;     ///< dot(normal, p) for each point p of the plane [m]
    Real farthest;     ///< largest distance of a vertex from the origin [m]

    /// Distance of the light along a unit direction that hits it [m]. Near the plane rounding could move the point
    /// arbitrarily far, but no point of a polygon is farther away than its farthest vertex.
    NUSSELT_HD Real distance_along(const Vec3<Real>& wi) const noexcept {
        const Real cosine = dot(normal, wi);
        const auto ahead = cosine * distance > Real(0);
        const Real along = distance / select(ahead, cosine, Real(1));
        return select(ahead, min(along, farthest), farthest);
    }
};

template <class Real, class Single>
NUSSELT_HD inline LightPlane<Real> broadcast(const LightPlane<Single>& plane) noexcept {
    return {broadcast<Real>(plane.normal), Real(plane.distance), Real(plane.farthest)};
}

NUSSELT_NAMESPACE_END
