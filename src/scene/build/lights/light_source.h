#pragma once
/// Lights that are no shapes, as importers describe them.

#include "scene/build/built_shape.h"
#include "scene/build/lights/environment.h"
#include "scene/model/profiles/luminaire.h"
#include "scene/model/transform.h"

#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace nusselt::scene {

/// A light that is no shape, in world space.
struct LightSourceDescription {
    /// Its name in the names of lights, such as "spot light"; a constant of the importer.
    std::string_view kind;
    Location origin;
    /// The emission is to be scaled to `power`, if there is one. The texture of a point light is the index of a request;
    /// half_extent is that of the shorter side of its image on both axes. The map of an environment is the index of a request;
    /// its radiance is that of a texel of 1.
    std::variant<PointLight, DistantLight, EnvironmentLight> light;
    /// The power if the luminance of the emission were one [W].
    std::optional<double> power = {};
    /// Of point lights with a profile. Without `power`, the intensity is a factor of what was measured, for each channel.
    std::shared_ptr<const Luminaire> luminaire = {};
    /// Of environments: what a surface with their axis z as its normal receives, likewise [W/m^2].
    std::optional<double> irradiance = {};
    /// Of environments: a sky in place of an image. Radiance is a factor then.
    std::optional<SkyDescription> sky = {};
};

/// The axes of the space of a light in world space.
struct LightFrame {
    Float3 x, y, z; ///< orthonormal, of the handedness of the transform
    bool keeps_angles = true;
};

/// The frame of a transform: z is that of the transform, and the others follow where it does not keep angles. Nothing if
/// the transform is singular or not finite.
std::optional<LightFrame> light_frame(const Transform& world_from_light);

/// Adds light sources with an emitter for each. Those whose image or profile is black are left out with a warning.
/// \param textures of the scene
/// \throws SceneError if an emission is out of range, or an image does not fit its light
void add_light_sources(const std::vector<LightSourceDescription>& sources,
                       const std::vector<Texture>& textures, BuiltShape& shapes);

} // namespace nusselt::scene
