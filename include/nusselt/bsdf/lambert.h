#pragma once
/// The Lambertian BRDF.

#include <nusselt/bsdf/components.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

template <class Real>
struct Lambert {
    Vec3<Real> albedo; ///< reflected fraction per colour channel, in [0, 1]

    /// The BRDF, without the cosine [1/sr]: albedo / pi.
    /// \param wi unit direction to the light in shading space; 0 where wi.z <= 0.
    NUSSELT_HD Vec3<Real> eval(const Vec3<Real>& wi) const noexcept {
        const Real inside = select(wi.z > Real(0), Real(1 / kPi<scalar_t<Real>>), Real(0));
        return inside * albedo;
    }

    NUSSELT_HD BrdfComponents<Real> eval_components(const Vec3<Real>& wi) const noexcept {
        return {eval(wi), {Real(0), Real(0), Real(0)}};
    }
};

NUSSELT_NAMESPACE_END
