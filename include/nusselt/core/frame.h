#pragma once
/// Right-handed orthonormal frames. Shading space has the shading point as origin and the normal as +z.

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

template <class Real>
struct Frame {
    Vec3<Real> t; ///< x axis in world space
    Vec3<Real> b; ///< y axis
    Vec3<Real> n; ///< z axis

    /// Completes a unit normal to a frame without branches or poles (Duff et al. 2017, JCGT 6(1)).
    NUSSELT_HD static Frame from_normal(const Vec3<Real>& normal) noexcept {
        const Real sign = copysign(Real(1), normal.z);
        const Real a = Real(-1) / (sign + normal.z);
        const Real c = normal.x * normal.y * a;
        return {{fma(sign * normal.x * normal.x, a, Real(1)), sign * c, -sign * normal.x},
                {c, fma(normal.y * normal.y, a, sign), -normal.y},
                normal};
    }

    NUSSELT_HD Vec3<Real> to_local(const Vec3<Real>& world) const noexcept {
        return {dot(t, world), dot(b, world), dot(n, world)};
    }
    NUSSELT_HD Vec3<Real> to_world(const Vec3<Real>& local) const noexcept {
        return local.x * t + local.y * b + local.z * n;
    }
};

/// The same frame in all lanes.
template <class Real, class Single>
NUSSELT_HD inline Frame<Real> broadcast(const Frame<Single>& frame) noexcept {
    return {broadcast<Real>(frame.t), broadcast<Real>(frame.b), broadcast<Real>(frame.n)};
}

NUSSELT_NAMESPACE_END
