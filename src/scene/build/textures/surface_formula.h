#pragma once
/// Materials as importers describe them: numbers and colours that may be images, or formulas of images.

#include "scene/build/textures/texture_plan.h"

namespace nusselt::scene {

/// A material whose textures are formulas.
struct SurfaceFormula {
    BrdfModel model = BrdfModel::lambert;
    TextureValue diffuse = grey_value(0);
    TextureValue f0 = grey_value(0);
    TextureValue roughness = grey_value(1); ///< perceptual; of Phong lobes, that of an equally wide lobe
    double exponent = 0;                    ///< of Phong lobes
    TextureValue alpha = grey_value(1);
    TextureValue bump = grey_value(0); ///< height [bump_unit]
    BumpUnit bump_unit = BumpUnit::metre;
    TextureValue normal = grey_value(0); ///< without a node if there is no normal map
};

/// The mean of the channels.
inline double mean(const Float3& c) {
    return (static_cast<double>(c.x) + static_cast<double>(c.y) + static_cast<double>(c.z)) / 3;
}

/// The material of a surface, without name. Its textures are indices of requests to `planner`.
/// \param origin  where the material is defined
Material make_material(const SurfaceFormula& surface, TexturePlanner& planner, const Location& origin);

/// The material of surfaces that emit but reflect nothing.
Material black_material();

} // namespace nusselt::scene
