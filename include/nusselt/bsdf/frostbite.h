#pragma once
/// The Frostbite BRDF: Disney diffuse, renormalised, plus GGX with height-correlated Smith and Schlick.
///
/// S. Lagarde, C. de Rousiers 2014, Moving Frostbite to Physically Based Rendering, SIGGRAPH course,
/// Sec. 3.1:
///   diffuse  albedo E / pi (1 + (F90 - 1)(1 - n.l)^5) (1 + (F90 - 1)(1 - n.v)^5),
///            F90 = r / 2 + 2 r (l.h)^2,  E = 1 - r (1 - 1 / 1.51)
///   specular D V F,  D = a^2 / (pi ((n.h)^2 (a^2 - 1) + 1)^2),  F = f0 + (1 - f0)(1 - l.h)^5,
///            V = 1 / 2 / (n.l sqrt((n.v)^2 (1 - a^2) + a^2) + n.v sqrt((n.l)^2 (1 - a^2) + a^2))
/// with perceptual roughness r and a = r^2. The diffuse lobe is Burley's (2012, Physically-Based Shading at
/// Disney) except for F90 and E; D is Eq. 33 of Walter et al. 2007, doi:10.2312/EGWR/EGSR07/195-206; V is Eq. 99
/// of Heitz 2014, JCGT 3(2), over 4 n.l n.v; F is from Schlick 1994, doi:10.1111/1467-8659.1330233.

#include <nusselt/bsdf/components.h>
#include <nusselt/bsdf/ggx.h>

NUSSELT_NAMESPACE_BEGIN

/// Smallest denominator of the visibility term. Only directions whose cosines sum to less than 1e-16 reach
/// it, where the BRDF (though not its product with the cosine) would leave the range of float.
inline constexpr double kSmallestVisibilityDenominator = 1e-20;

/// One surface point seen from one direction: the constructor does what does not depend on the light.
///
/// All directions are unit vectors in shading space, pointing away from the surface; z is the cosine. Values
/// are those of the BRDF, without the cosine [1/sr]. They are 0 where wi.z <= 0 or wo.z <= 0, exactly equal
/// after swapping wo and wi, never NaN and at most 1.7e27 (specular) or 1.32 (diffuse) for albedo and f0 up
/// to 1; eval_specular(wi) times wi.z is at most 1.6e11.
///
/// The specular part alone reflects at most what it receives. The parts are independent of each other: with
/// albedo 1 and f0 0.04 their sum stays below 1 up to 1.2 rad from the normal, then grows to 1.117 at
/// roughness 1 towards the horizon; with both albedo and f0 large it is larger.
///
/// \tparam Real float, double, long double or a pack with one surface point per lane.
template <class Real>
class Frostbite {
    using Scalar = scalar_t<Real>;

public:
    /// \param wo        unit direction to the eye; parallel to the normal is fine.
    /// \param albedo    of the diffuse part, in [0, 1].
    /// \param f0        reflectance of the specular part at normal incidence, in [0, 1].
    /// \param roughness perceptual ("linear") roughness, clamped to [0, 1]; the alpha of GGX is ggx_alpha() of it.
    NUSSELT_HD Frostbite(const Vec3<Real>& wo, const Vec3<Real>& albedo, const Vec3<Real>& f0,
                         const Real& roughness) noexcept
        : wo_(wo), f0_(f0), roughness_(min(max(roughness, Real(0)), Real(1))) {
        const Real alpha = ggx_alpha(roughness_);
        alpha2_ = alpha * alpha;
        slant_o_ = slant(wo.z);
        grazing_o_ = fifth_power_of_complement(wo.z);
        // The factor E_f of Lagarde and de Rousiers goes from 1 to 1 / 1.51.
        const Real energy = Real(1) - roughness_ * Real(1 - 1 / Scalar(1.51L));
        diffuse_ = (energy * Real(1 / kPi<Scalar>)) * albedo;
    }

    NUSSELT_HD Vec3<Real> eval(const Vec3<Real>& wi) const noexcept {
        const BrdfComponents<Real> components = eval_components(wi);
        return components.diffuse + components.specular;
    }

    NUSSELT_HD BrdfComponents<Real> eval_components(const Vec3<Real>& wi) const noexcept {
        const HalfVector half(wo_ + wi);
        return {diffuse(wi, half), specular(wi, half)};
    }

    /// Estimate of the directional albedo of the diffuse part, for coefficients of multiple importance sampling: off by
    /// at most 5 %. The half vector is taken to be at 45 degrees from either direction.
    NUSSELT_HD Vec3<Real> diffuse_albedo() const noexcept {
        const Real bias = retroreflection(Real(Scalar(0.5)));
        // The mean of (1 - wi.z)^5 under the cosine is 1 / 21.
        const Real scatter = (Real(1) + bias * Real(1 / Scalar(21))) * (Real(1) + bias * grazing_o_);
        return (Real(kPi<Scalar>) * scatter) * diffuse_;
    }

    /// The diffuse part of eval().
    NUSSELT_HD Vec3<Real> eval_diffuse(const Vec3<Real>& wi) const noexcept {
        return diffuse(wi, HalfVector(wo_ + wi));
    }

    /// The specular part of eval().
    NUSSELT_HD Vec3<Real> eval_specular(const Vec3<Real>& wi) const noexcept {
        return specular(wi, HalfVector(wo_ + wi));
    }

private:
    /// wo + wi has twice the length of the cosine between each of them and the half vector.
    struct HalfVector {
        NUSSELT_HD explicit HalfVector(const Vec3<Real>& both) noexcept
            : sum(both), cos2(min(Real(Scalar(0.25)) * dot(sum, sum), Real(1))) {}

        Vec3<Real> sum; ///< of wo and wi
        Real cos2;      ///< squared cosine between the half vector and either direction
    };

    NUSSELT_HD static Real fifth_power_of_complement(const Real& x) noexcept {
        const Real y = max(Real(1) - x, Real(0));
        const Real y2 = y * y;
        return y2 * y2 * y;
    }

    /// The root in the Smith terms.
    NUSSELT_HD Real slant(const Real& cosine) const noexcept {
        return sqrt(cosine * cosine * (Real(1) - alpha2_) + alpha2_);
    }

    NUSSELT_HD Vec3<Real> where_lit(const Vec3<Real>& wi, const Real& factor,
                                    const Vec3<Real>& f) const noexcept {
        const auto lit = (wo_.z > Real(0)) & (wi.z > Real(0));
        return select(lit, factor, Real(0)) * f;
    }

    /// F90 - 1. \param cos2 squared cosine between the half vector and either direction
    NUSSELT_HD Real retroreflection(const Real& cos2) const noexcept {
        return roughness_ * (Real(Scalar(0.5)) + Real(2) * cos2) - Real(1);
    }

    NUSSELT_HD Vec3<Real> diffuse(const Vec3<Real>& wi, const HalfVector& half) const noexcept {
        const Real bias = retroreflection(half.cos2);
        const Real scatter_i = Real(1) + bias * fifth_power_of_complement(wi.z);
        const Real scatter_o = Real(1) + bias * grazing_o_;
        return where_lit(wi, scatter_i * scatter_o, diffuse_);
    }

    NUSSELT_HD Vec3<Real> specular(const Vec3<Real>& wi, const HalfVector& half) const noexcept {
        const Real distribution = ggx_distribution(ggx_ratio(half.sum, alpha2_), alpha2_);
        const Real denominator = wi.z * slant_o_ + wo_.z * slant(wi.z);
        const Real visibility =
            Real(Scalar(0.5)) / max(denominator, Real(Scalar(kSmallestVisibilityDenominator)));
        const Real grazing = fifth_power_of_complement(sqrt(half.cos2));
        const Vec3<Real> fresnel{f0_.x + (Real(1) - f0_.x) * grazing, f0_.y + (Real(1) - f0_.y) * grazing,
                                 f0_.z + (Real(1) - f0_.z) * grazing};
        return where_lit(wi, distribution * visibility, fresnel);
    }

    Vec3<Real> wo_;
    Vec3<Real> f0_;
    Vec3<Real> diffuse_; ///< albedo with all factors that do not depend on directions
    Real roughness_;
    Real alpha2_;
    Real slant_o_;
    Real grazing_o_; ///< (1 - wo.z)^5
};

NUSSELT_NAMESPACE_END
