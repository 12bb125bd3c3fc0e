#pragma once
/// Light rigs change the lights and materials of a scene after it was loaded. docs/lights.md describes them and their
/// files.

#include "scene/model/limits.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace nusselt::scene {

constexpr std::size_t kMaxRigLights = 1'000'000; ///< in a scene to which a rig adds lights

/// An index or a name. A name selects exact matches; without any, it is a pattern in which * stands for any text and ? for
/// any character.
using Selector = std::variant<std::size_t, std::string>;

struct Rotation {
    Double3 axis;
    double degrees = 0;
};

/// An emission of lights of the kinds that have this quantity.
struct GivenEmission {
    EmissionQuantity quantity;
    Float3 value;
};

/// How the light depends on the direction.
struct GivenProfile {
    std::shared_ptr<const Luminaire> luminaire = {}; ///< null: as before
    std::optional<double> spread = {};               ///< [degrees]
    std::optional<double> angle = {};                ///< ProfileRequest::angle
    std::optional<HoneycombAngles> honeycomb = {};
    bool is_empty() const { return luminaire == nullptr && !spread && !angle && !honeycomb; }
    bool operator==(const GivenProfile&) const = default;
};

/// What a light shows.
struct GivenImage {
    std::shared_ptr<const EmissionTexture> image = {};    ///< null: as before
    std::shared_ptr<const EnvironmentMapTexels> map = {}; ///< null: as before
    std::optional<Float3> scale = {};                     ///< the radiance of a texel of 1 [W/(sr m^2)]
    bool operator==(const GivenImage&) const = default;
};

/// Changes of a light, in the order of their application.
struct LightChanges {
    std::optional<std::string> name;
    std::optional<Lights> shape;          ///< one light, whose emission is ignored
    std::optional<Double3> scale;         ///< along the axes of the world, about the centroid
    std::optional<Rotation> rotation;     ///< about the centroid
    std::optional<Float3> center;         ///< where the centroid goes
    std::optional<Double3> move;          ///< [m]
    std::optional<Rotation> map_rotation; ///< of the map of an environment
    GivenImage image;
    GivenProfile profile;
    std::optional<GivenEmission> emission;
    std::optional<double> kelvin; ///< colour of this temperature; the luminance stays
    std::optional<double> power;  ///< of the whole light [W], with channels weighted by their luminance
    std::optional<double> scale_radiance; ///< or another emission
    std::optional<bool> two_sided;
    std::optional<bool> enabled;
    bool remove = false;
};

/// New lights of equal shape.
struct LightAddition {
    std::string name;                    ///< followed by a number if there are several
    std::optional<std::string> material; ///< the name of the material of surfaces; default: black
    std::vector<Double3> offsets;        ///< one for each light [m]
};

struct RigLight {
    std::string where; ///< file and path in it, for messages
    std::variant<Selector, LightAddition> lights;
    LightChanges changes;
};

struct RigMaterial {
    std::string where;
    Selector materials;
    std::optional<BrdfModel> model;
    std::optional<Float3> diffuse;
    std::optional<Float3> f0;
    std::optional<float> roughness;
    std::optional<float> exponent;
};

struct Rig {
    std::vector<RigLight> lights;
    std::vector<RigMaterial> materials;
};

/// Whether a text matches a pattern with * and ?.
bool matches(std::string_view text, std::string_view pattern);

/// Applies a rig. Indices count the lights of the scene before the changes, then those that the rig adds. Scene::warnings get
/// one for each light that the rig leaves without any emission: because of its profile, or its portal, say.
///
/// Throws std::runtime_error with the entry and the field if an entry selects nothing or cannot be applied to what it
/// selects. The scene must not be used then.
void apply_rig(const Rig& rig, Scene& scene);

} // namespace nusselt::scene
