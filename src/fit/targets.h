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
#include <nusselt/bsdf/phong.h>
#include <nusselt/simd/pack.h>

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

/// The exponent whose lobe is as wide as that of a microfacet BRDF of a roughness, see phong_alpha().
inline double phong_exponent(double roughness) {
    const double alpha = ggx_alpha(roughness);
    return 0.5 * (1 / (alpha * alpha) - 1);
}

/// A lobe of albedo 1 at normal incidence. It is sampled as a whole, also where it is below the surface.
template <class Real>
class PhongSpecular {
public:
    explicit PhongSpecular(const Slice& slice)
        : exponent_(phong_exponent(slice.roughness)), mirror_(mirrored(direction_to_eye<Real>(slice))) {}

    Real eval(const Vec3<Real>& wi) const noexcept {
        const Real lit = select(wi.z > Real(0), wi.z, Real(0));
        return Real((exponent_ + 2) * 0.5 / kPi<double>) * lit * power(wi);
    }

    Vec3<Real> sample(const Real& cos_phi, const Real& sin_phi, const Real& u_y) const noexcept {
        // The cosine is a root of 1 - u_y, whose logarithm is that of the cosine of another angle.
        const SinCos<Real> root{sqrt(u_y * (Real(2) - u_y)), Real(1) - u_y};
        const Real logarithm = negative_log_of_cosine(root) * Real(1 / (exponent_ + 1));
        const Real cosine = exp_of_negative(logarithm);
        const Real sine = sqrt(max(Real(1) - exp_of_negative(Real(2) * logarithm), Real(0)));
        const Vec3<Real> tangent{mirror_.z, Real(0), -mirror_.x};
        return sine * (cos_phi * tangent + sin_phi * Vec3<Real>{Real(0), Real(1), Real(0)}) +
               cosine * mirror_;
    }

    Real pdf(const Vec3<Real>& wi) const noexcept {
        return Real((exponent_ + 1) * 0.5 / kPi<double>) * power(wi);
    }

private:
    /// In single precision, whose functions are vectors of polynomials: the fit needs no more, and calls this often.
    Real power(const Vec3<Real>& wi) const noexcept {
        using Single = Pack<float, RealTraits<Real>::kLanes>;
        const SinCos<Single> angle{single(min(length(cross(mirror_, wi)), Real(1))),
                                   single(dot(mirror_, wi))};
        const Single value =
            exp_of_negative(Single(static_cast<float>(exponent_)) * negative_log_of_cosine(angle));
        return in_double(select(angle.cos > Single(0), value, Single(0)));
    }

    static Pack<float, RealTraits<Real>::kLanes> single(const Real& x) noexcept {
        double from[RealTraits<Real>::kLanes];
        float to[RealTraits<Real>::kLanes];
        x.store(from);
        for (int i = 0; i < RealTraits<Real>::kLanes; ++i) to[i] = static_cast<float>(from[i]);
        return Pack<float, RealTraits<Real>::kLanes>::load(to);
    }
    static Real in_double(const Pack<float, RealTraits<Real>::kLanes>& x) noexcept {
        float from[RealTraits<Real>::kLanes];
        double to[RealTraits<Real>::kLanes];
        x.store(from);
        for (int i = 0; i < RealTraits<Real>::kLanes; ++i) to[i] = static_cast<double>(from[i]);
        return Real::load(to);
    }

    double exponent_;
    Vec3<Real> mirror_;
};

} // namespace nusselt::fit
