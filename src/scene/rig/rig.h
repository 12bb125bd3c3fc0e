#pragma once
/// Light rigs: changes of the lights and materials of a scene, made after it was loaded. docs/lights.md describes them
/// and the files that hold them.

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace nusselt::scene {

constexpr std::size_t kMaxRigLights = 1'000'000; ///< in a scene, when a rig adds some
constexpr double kMaxRadiance = 1e30;            ///< [W/(sr m^2)]

/// An index, or a name. As name, the exact one counts if there is one; else * and ? stand for any text and any
/// character.
using Selector = std::variant<std::size_t, std::string>;

struct Rotation {
    Double3 axis;
    double degrees = 0;
};

/// Changes of a light, in the order in which they are made.
struct LightChanges {
    std::optional<std::string> name;
    std::optional<Lights> shape;      ///< one light, whose emission does not count
    std::optional<Double3> scale;     ///< along the axes of the world, about the centroid
    std::optional<Rotation> rotation; ///< about the centroid
    std::optional<Float3> center;     ///< where the centroid goes
    std::optional<Double3> move;      ///< [m]
    std::optional<Float3> radiance;   ///< [W/(sr m^2)]
    std::optional<double> kelvin;     ///< colour of this temperature; the luminance stays
    std::optional<double> power;      ///< of the whole light [W], a mean of the channels by their luminance
    std::optional<double> scale_radiance;
    std::optional<bool> two_sided;
    std::optional<bool> enabled;
    bool remove = false;
};

/// New lights of equal shape.
struct LightAddition {
    std::string name;                    ///< followed by a number if there are several
    std::optional<std::string> material; ///< name of that of the surfaces; nothing for black
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
};

struct Rig {
    std::vector<RigLight> lights;
    std::vector<RigMaterial> materials;
};

/// Whether a text matches a pattern with * and ?.
bool matches(std::string_view text, std::string_view pattern);

/// Makes the changes of a rig. Indices count the lights of the scene as they are before, then those that are added.
///
/// Throws std::runtime_error with the entry and the field if an entry selects nothing or cannot be applied to what it
/// selects. The scene must not be used then.
void apply_rig(const Rig& rig, Scene& scene);

} // namespace nusselt::scene
