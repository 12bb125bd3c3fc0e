#pragma once
/// Edits of the lights of a scene by the user.

#include "scene/model/scene.h"
#include "scene/rig/rig.h"

#include <cstddef>
#include <map>
#include <string>

namespace nusselt::viewer {

/// The edit of one light. The defaults change nothing.
struct LightEdit {
    scene::Double3 move = {0, 0, 0}; ///< [m]
    double size = 1;                 ///< factor on all lengths, about the centroid
    double brightness = 1;           ///< factor on the radiance
    bool is_enabled = true;

    bool operator==(const LightEdit&) const = default;
};

/// Edits by the index of the light in Scene::emitters, as the scene was loaded.
class LightEdits {
public:
    /// The edit of a light; the defaults if it is unchanged.
    LightEdit get(std::size_t light) const;
    void set(std::size_t light, const LightEdit& edit);
    bool empty() const { return edits_.empty(); }

    /// A copy of the loaded scene with the edits. \throws std::runtime_error if one cannot be made, such as a move beyond
    /// the largest coordinate
    scene::Scene applied_to(const scene::Scene& loaded) const;

    /// The light rig that does the same, see docs/lights.md.
    std::string rig_text() const;

    bool operator==(const LightEdits&) const = default;

private:
    std::map<std::size_t, LightEdit> edits_; ///< without those that change nothing
};

} // namespace nusselt::viewer
