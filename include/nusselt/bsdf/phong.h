#pragma once
/// The Phong BRDF: a power of the cosine with the mirrored direction.
///
/// B. T. Phong 1975, Illumination for Computer Generated Pictures, doi:10.1145/360825.360839, normalised as N. Billen,
/// P. Dutre 2016, Line Sampling for Direct Illumination, Eq. 9: albedo (n + 2) / (2 pi) (r.l)^n. The albedo is reached
/// at normal incidence; elsewhere less is reflected.

#include <nusselt/bsdf/lambert.h>
#include <nusselt/core/exponential.h>

NUSSELT_NAMESPACE_BEGIN

/// The direction to the eye, mirrored at the surface.
/// \param wo unit, in shading space.
template <class Real>
NUSSELT_HD constexpr Vec3<Real> mirrored(const Vec3<Real>& wo) noexcept {
    return {-wo.x, -wo.y, wo.z};
}

/// Factor of the lobe such that its cosine-weighted integral is 1 at normal incidence [1/sr].
template <class Real>
NUSSELT_HD constexpr Real phong_normalisation(const Real& exponent) noexcept {
    return (exponent + Real(2)) * Real(scalar_t<Real>(0.5) / kPi<scalar_t<Real>>);
}

/// The alpha of a Beckmann distribution whose reflections are as wide. Half vectors turn by half as much as directions:
/// about the mirrored direction, it falls like exp(-angle^2 / (4 alpha^2)), a power like exp(-n angle^2 / 2). GGX of the same
/// alpha has a narrower core and longer tails. The square root is the roughness by which tables of Phong lobes are sampled; exponent 0 is at roughness 1.
/// \param exponent at least 0.
template <class Real>
NUSSELT_HD inline Real phong_alpha(const Real& exponent) noexcept {
    return Real(1) / sqrt(fma(Real(2), exponent, Real(1)));
}

/// One surface point seen from one direction.
/// \tparam Real float, double, long double or a pack with one surface point per lane.
template <class Real>
class Phong {
public:
    /// \param wo       unit direction to the eye in shading space.
    /// \param albedo   per colour channel, in [0, 1].
    /// \param exponent at least 0; any real number. Between 0 and 1, integrals along lines lose up to 1e-3, see
    ///                 phong_integral().
    NUSSELT_HD Phong(const Vec3<Real>& wo, const Vec3<Real>& albedo, const Real& exponent) noexcept
        : mirror_(mirrored(wo)), albedo_(albedo), exponent_(exponent) {}

    /// The BRDF, without the cosine [1/sr].
    /// \param wi unit direction to the light in shading space; 0 where wi.z <= 0 or wo.z <= 0.
    NUSSELT_HD Vec3<Real> eval(const Vec3<Real>& wi) const noexcept {
        // The cross product keeps the precision that the cosine loses for narrow lobes.
        const Vec3<Real> across = cross(mirror_, wi);
        const SinCos<Real> angle{min(length(across), Real(1)), dot(mirror_, wi)};
        const Real power = exp_of_negative(exponent_ * negative_log_of_cosine(angle));
        const auto lit = (wi.z > Real(0)) & (mirror_.z > Real(0)) & (angle.cos > Real(0));
        return select(lit, phong_normalisation(exponent_) * power, Real(0)) * albedo_;
    }

    /// The direction to the eye, mirrored at the surface; the maximum of the lobe.
    NUSSELT_HD const Vec3<Real>& mirror() const noexcept { return mirror_; }
    NUSSELT_HD const Vec3<Real>& albedo() const noexcept { return albedo_; }
    NUSSELT_HD const Real& exponent() const noexcept { return exponent_; }

private:
    Vec3<Real> mirror_, albedo_;
    Real exponent_;
};

/// A Phong lobe above a Lambertian base, neither of which knows of the other: their albedos should not add up to more
/// than 1.
template <class Real>
struct LambertPhong {
    Lambert<Real> lambert;
    Phong<Real> phong;

    /// The BRDF, without the cosine [1/sr].
    /// \param wi unit direction to the light in shading space; 0 where wi.z <= 0.
    NUSSELT_HD Vec3<Real> eval(const Vec3<Real>& wi) const noexcept {
        return lambert.eval(wi) + phong.eval(wi);
    }

    NUSSELT_HD BrdfComponents<Real> eval_components(const Vec3<Real>& wi) const noexcept {
        return {lambert.eval(wi), phong.eval(wi)};
    }
};

NUSSELT_NAMESPACE_END
