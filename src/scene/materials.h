#pragma once
/// Reduction of pbrt's materials to scene::Material. The formulas are listed in docs/materials.md.

#include "scene/parameters.h"
#include "scene/textures.h"

#include <optional>
#include <string>

namespace nusselt::scene {

/// A Material or MakeNamedMaterial directive.
struct MaterialDirective {
    std::string name; ///< of the material; its type if it has none
    std::string type; ///< "matte", "coateddiffuse", ...
    ParameterList parameters;
};

/// Nothing if surfaces of this material are invisible. The diffuse_texture of the result is an index into
/// textures.requests(). Throws SceneError on parameters of impossible values or missing textures.
std::optional<Material> reduce_material(MaterialDirective& directive, const TextureTable& textures,
                                        Warnings& warnings);

/// GGX alpha from pbrt v3's roughness parameter.
double alpha_from_roughness_v3(double roughness);
/// GGX alpha from pbrt v4's roughness parameter.
double alpha_from_roughness_v4(double roughness);
/// Our perceptual roughness; alpha is clamped to [1e-3, 1] first.
float roughness_from_alpha(double alpha);
/// Fresnel reflectance of a conductor in air at normal incidence.
double conductor_f0(double eta, double k);
/// Fresnel reflectance of a dielectric in air at normal incidence.
double dielectric_f0(double eta);

} // namespace nusselt::scene
