#pragma once
/// Edits of the lights of a scene by the user.

#include "scene/model/scene.h"
#include "scene/rig/rig.h"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace nusselt::viewer {

enum class LightShape { panel, tube, sphere, disk };

inline constexpr std::array kLightShapes = {LightShape::panel, LightShape::tube, LightShape::sphere,
                                            LightShape::disk};
std::string_view name_of(LightShape shape);

/// A light that the user adds.
struct NewLight {
    std::string name;
    LightShape shape = LightShape::panel;
    scene::Double3 center;
    scene::Double3 direction; ///< unit: the normal of a panel or a disk, the axis of a tube; any for a sphere
    double size = 1; ///< the side of a panel, the length of a tube, the diameter of a sphere or a disk [m]
    scene::Float3 radiance = {1, 1, 1};

    bool operator==(const NewLight&) const = default;
};

// Temperatures for which rigs have a colour [K].
inline constexpr double kLowestKelvin = 1000;
inline constexpr double kHighestKelvin = 40000;

struct Temperature {
    double kelvin = 6500;
    bool operator==(const Temperature&) const = default;
};

/// The colour of a light: as it was, of a black body, or an emission. Black bodies keep the luminance.
using LightColour = std::variant<std::monostate, Temperature, scene::Float3>;

/// The edit of one light. The defaults change nothing.
struct LightEdit {
    scene::Double3 move = {0, 0, 0}; ///< [m]
    double size = 1;                 ///< factor on all lengths, about the centroid
    double brightness = 1;           ///< factor on the emission
    bool is_enabled = true;
    /// A rotation about the centroid: its direction is the axis, its length the angle [degrees], counter-clockwise as seen
    /// from the tip of the axis.
    scene::Double3 turn = {0, 0, 0};
    LightColour colour = {};
    scene::GivenProfile profile = {}; ///< another profile, spread, honeycomb or angle of the profile
    scene::GivenImage image = {};     ///< another image, or another map of an environment
    scene::Double3 map_turn = {0, 0,
                               0}; ///< a rotation of the map, which leaves a portal in its place, as `turn`
    bool is_removed = false;
    std::optional<NewLight> added = {}; ///< the light, if it is none of the scene

    bool operator==(const LightEdit&) const = default;
};

/// The rotation by `first`, then by `second`; rotations as in LightEdit::turn.
scene::Double3 combined_turn(const scene::Double3& first, const scene::Double3& second);

/// The parts of a light where an edit puts them.
scene::Lights placed(scene::Lights parts, const LightEdit& edit);

/// Edits by the index of the light in Scene::emitters, as the scene was loaded. Lights that the user adds have the indices
/// after those.
class LightEdits {
public:
    /// The edit of a light; the defaults if it is unchanged.
    LightEdit get(std::size_t light) const;
    void set(std::size_t light, const LightEdit& edit);
    bool empty() const { return edits_.empty(); }

    /// Adds a light; its name gets a number. \returns its index
    std::size_t add(const scene::Scene& loaded, NewLight light);
    void remove(std::size_t light);

    // The lights with those that were added, and without those that were removed.
    std::vector<std::size_t> lights(const scene::Scene& loaded) const; ///< in order
    bool has(const scene::Scene& loaded, std::size_t light) const;
    /// \param light has() it
    std::string name(const scene::Scene& loaded, std::size_t light) const;

    // A light where its edit puts it.
    scene::Lights placed(const scene::Scene& loaded, std::size_t light) const;
    scene::Double3 center(const scene::Scene& loaded, std::size_t light) const; ///< the centroid
    /// What the emission of a light is.
    const scene::EmissionQuantity& quantity(const scene::Scene& loaded, std::size_t light) const;
    /// The mean emission of a light, with its colour and brightness from before the edit.
    scene::Float3 emission_before(const scene::Scene& loaded, std::size_t light) const;

    /// A copy of the loaded scene with the edits. \throws std::runtime_error if one cannot be made, such as a move beyond
    /// the largest coordinate
    scene::Scene applied_to(const scene::Scene& loaded) const;

    /// The light rig that does the same, see docs/lights.md.
    std::string rig_text(const scene::Scene& loaded) const;

    bool operator==(const LightEdits&) const = default;

private:
    std::map<std::size_t, LightEdit> edits_; ///< without those that change nothing
};

} // namespace nusselt::viewer
