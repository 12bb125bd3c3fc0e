#pragma once
/// Formulas that convert the material parameters of other renderers to ours; docs/materials.md lists them.

#include "scene/model/scene.h"

namespace nusselt::scene {

/// The rule that converts a roughness parameter to the alpha of GGX.
enum class RoughnessRule {
    alpha,  ///< it is alpha
    v3,     ///< of pbrt v3 with remaproughness
    v4,     ///< of pbrt v4 with remaproughness
    disney, ///< its square is alpha
};

/// GGX alpha from pbrt v3's roughness parameter.
double alpha_from_roughness_v3(double roughness);
/// GGX alpha from pbrt v4's roughness parameter.
double alpha_from_roughness_v4(double roughness);
/// GGX alpha from a roughness parameter, which must not be negative; 0, perfectly smooth in pbrt, becomes 0.01.
double alpha_from_roughness(double roughness, RoughnessRule rule);
/// Our perceptual roughness; alpha is clamped to [1e-3, 1] first.
float roughness_from_alpha(double alpha);

/// Fresnel reflectance of a conductor in air at normal incidence.
double conductor_f0(double eta, double k);
/// Fresnel reflectance of a dielectric in air at normal incidence.
double dielectric_f0(double eta);
/// Reflectance at normal incidence of a conductor below a clear dielectric layer, which light leaves after any number
/// of reflections.
double coated_conductor_f0(double eta, double k, double coat_eta);

/// Diffuse albedo of a medium that fills a half space: the dipole model with equal refractive indices.
/// \param absorption,scattering  coefficients [1/length], not negative; the latter reduced by its anisotropy
double medium_albedo(double absorption, double scattering);

} // namespace nusselt::scene
