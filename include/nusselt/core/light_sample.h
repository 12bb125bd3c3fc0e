#pragma once
/// Samples, as all techniques return them, and hit points on planar lights.

#include <type_traits>

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// A direction towards a light, in the frame in which the light was given.
template <class Real>
struct LightSample {
    Vec3<Real> wi; ///< unit direction from the shading point to the light
    Real pdf; ///< density of wi; positive and finite, or exactly 0: no sample, wi and p are then meaningless
    Vec3<Real> p; ///< the point on the light [m], relative to the shading point; the shadow ray ends there
};

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
