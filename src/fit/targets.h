#pragma once
/// The BRDFs that can be fitted, each as a template on the number type: what the fit asks of a slice.
///
///     eval(wi)                        BRDF times cosine [1/sr], 0 below the horizon
///     sample(cos_phi, sin_phi, u_y)   direction by a density that resembles eval()
///     pdf(wi)                         that density [1/sr]

#include "fit/slice.h"

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/bsdf/ggx_visible_normals.h>
#include <nusselt/bsdf/lambert.h>

#include <algorithm>
#include <cmath>

namespace nusselt::fit {

/// BRDFs are 0 for wo on the horizon, where their limit is not: the last slice is seen from just above it.
inline constexpr double kSmallestCosine = 1e-6;

template <class Real>
Vec3<Real> direction_to_eye(const Slice& slice) {
    const double z = std::max(std::cos(slice.inclination), kSmallestCosine);
    return {Real(std::sqrt((1 - z) * (1 + z))), Real(0), Real(z)};
}

template <class Real>
class FrostbiteSpecular {
public:
    explicit FrostbiteSpecular(const Slice& slice)
        : brdf_(direction_to_eye<Real>(slice), {Real(0), Real(0), Real(0)},
                {Real(slice.f0), Real(slice.f0), Real(slice.f0)}, Real(slice.roughness)),
          normals_(direction_to_eye<Real>(slice), Real(ggx_alpha(slice.roughness))) {}

    Real eval(const Vec3<Real>& wi) const noexcept { return brdf_.eval_specular(wi).x * wi.z; }
    Vec3<Real> sample(const Real& cos_phi, const Real& sin_phi, const Real& u_y) const noexcept {
        return normals_.sample({sin_phi, cos_phi}, u_y);
    }
    Real pdf(const Vec3<Real>& wi) const noexcept { return normals_.pdf(wi); }

private:
    Frostbite<Real> brdf_;
    GgxVisibleNormals<Real> normals_;
};

/// Sampling by the cosine, for BRDFs without a peak.
template <class Real>
class CosineSampling {
public:
    Vec3<Real> sample(const Real& cos_phi, const Real& sin_phi, const Real& u_y) const noexcept {
        const Real r = sqrt(u_y);
        return {r * cos_phi, r * sin_phi, sqrt(Real(1) - u_y)};
    }
    Real pdf(const Vec3<Real>& wi) const noexcept { return max(wi.z, Real(0)) * Real(1 / kPi<double>); }
};

template <class Real>
class FrostbiteDiffuse : public CosineSampling<Real> {
public:
    explicit FrostbiteDiffuse(const Slice& slice)
        : brdf_(direction_to_eye<Real>(slice), {Real(1), Real(1), Real(1)}, {Real(0), Real(0), Real(0)},
                Real(slice.roughness)) {}

    Real eval(const Vec3<Real>& wi) const noexcept { return brdf_.eval_diffuse(wi).x * wi.z; }

private:
    Frostbite<Real> brdf_;
};

template <class Real>
class LambertTarget : public CosineSampling<Real> {
public:
    explicit LambertTarget(const Slice&) {}

    Real eval(const Vec3<Real>& wi) const noexcept {
        return Lambert<Real>{{Real(1), Real(1), Real(1)}}.eval(wi).x * wi.z;
    }
};

} // namespace nusselt::fit
