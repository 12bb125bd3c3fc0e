#pragma once
/// Points of surfaces, prepared for estimates of direct light.

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/bsdf/lambert.h>
#include <nusselt/bsdf/phong.h>
#include <nusselt/ltc/ltc.h>
#include <nusselt/ltc/table.h>

NUSSELT_NAMESPACE_BEGIN

/// A point of a surface as seen from one direction, in shading space with wo in the xz half-plane (shading_frame()).
/// \tparam Brdf with eval_components(wi), as Frostbite<Real>, Lambert<Real> and LambertPhong<Real>.
template <class Real, class Brdf = Frostbite<Real>>
struct GlossySurface {
    Vec3<Real> wo; ///< unit direction to the eye
    Real alpha;    ///< of GGX
    Brdf brdf;
    Ltc<Real> lobe;             ///< fit of the specular component times cosine
    Vec3<Real> diffuse_albedo;  ///< estimates of the directional albedo of both components, at least 0
    Vec3<Real> specular_albedo; ///< 0 where there is no specular component: its technique is then left out

    /// Whether there is a specular component.
    NUSSELT_HD mask_t<Real> is_glossy() const noexcept {
        return max(max(specular_albedo.x, specular_albedo.y), specular_albedo.z) > Real(0);
    }
};

/// The fit of a specular component by a table.
template <class Real>
struct SpecularFit {
    Ltc<Real> lobe;
    Vec3<Real> albedo;
};

/// \param table of the component, by perceptual roughness, cosine of the direction to the eye, and reflectance.
template <class Real>
NUSSELT_HD inline SpecularFit<Real> fit_of(const LtcTableView& table, const Real& roughness,
                                           const Real& cos_o, const Vec3<Real>& f0) noexcept {
    // One lobe has to do for all colour channels.
    const Real mean_f0 = (f0.x + f0.y + f0.z) * Real(scalar_t<Real>(1) / 3);
    return {Ltc<Real>(table.lookup(roughness, cos_o, mean_f0)), table.albedo(roughness, cos_o, f0)};
}

/// The same for Phong lobes.
/// \param table    of Phong lobes of albedo 1 at normal incidence, by the root of phong_alpha() and the cosine.
/// \param exponent see Phong.
/// \param albedo   of the lobe at normal incidence, in [0, 1].
template <class Real>
NUSSELT_HD inline SpecularFit<Real> phong_fit_of(const LtcTableView& table, const Real& exponent,
                                                 const Real& cos_o, const Vec3<Real>& albedo) noexcept {
    // Phong lobes know no Fresnel term: all samples of f0 are the same.
    const LtcCoefficients<Real> fit = table.lookup(sqrt(phong_alpha(exponent)), cos_o, Real(0));
    return {Ltc<Real>(fit), fit.albedo * albedo};
}

/// A surface with the Frostbite BRDF.
/// \param cos_o     cosine between the normal and the direction to the eye. Below the horizon the surface is black.
/// \param albedo    of the diffuse part, in [0, 1].
/// \param f0        reflectance of the specular part at normal incidence, in [0, 1].
/// \param roughness perceptual, in [0, 1].
/// \param table     of the specular Frostbite BRDF.
template <class Real>
NUSSELT_HD inline GlossySurface<Real> make_glossy_surface(const Real& cos_o, const Vec3<Real>& albedo,
                                                          const Vec3<Real>& f0, const Real& roughness,
                                                          const LtcTableView& table) noexcept {
    const Real sin_o = sqrt(max((Real(1) - cos_o) * (Real(1) + cos_o), Real(0)));
    const Vec3<Real> wo{sin_o, Real(0), cos_o};
    const Frostbite<Real> brdf(wo, albedo, f0, roughness);
    const SpecularFit<Real> fit = fit_of(table, roughness, cos_o, f0);
    return {wo, ggx_alpha(roughness), brdf, fit.lobe, brdf.diffuse_albedo(), fit.albedo};
}

/// A Lambertian surface with a Phong lobe.
/// \param cos_o    as for make_glossy_surface().
/// \param albedo   of the Lambertian part, in [0, 1].
/// \param specular albedo of the lobe at normal incidence, in [0, 1].
/// \param exponent 0 or at least 1; any real number. Between 0 and 1, integrals along lines lose up to 1e-3, see
///                 phong_integral().
/// \param table    see phong_fit_of().
template <class Real>
NUSSELT_HD inline GlossySurface<Real, LambertPhong<Real>>
make_phong_surface(const Real& cos_o, const Vec3<Real>& albedo, const Vec3<Real>& specular,
                   const Real& exponent, const LtcTableView& table) noexcept {
    const Real sin_o = sqrt(max((Real(1) - cos_o) * (Real(1) + cos_o), Real(0)));
    const Vec3<Real> wo{sin_o, Real(0), cos_o};
    const SpecularFit<Real> fit = phong_fit_of(table, exponent, cos_o, specular);
    return {
        wo,        phong_alpha(exponent), {{albedo}, Phong<Real>(wo, specular, exponent)}, fit.lobe, albedo,
        fit.albedo};
}

NUSSELT_NAMESPACE_END
