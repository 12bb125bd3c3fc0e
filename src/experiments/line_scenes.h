#pragma once
/// Scenes that line samples are measured in.

#include "experiments/run.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace nusselt::experiments {

enum class SceneOrigin {
    shipped,
    published, ///< below the folder that the environment variable NUSSELT_SCENES names
};

struct LineScene {
    std::string name; ///< as in tables and names of files
    std::string file;
    std::string rig = {}; ///< below scenes/rigs; empty: none
    SceneOrigin origin = SceneOrigin::shipped;
};

/// The grid, the logo, the soup and Sponza under lights that are a metre wide or more.
std::vector<LineScene> scenes_with_large_lights();

/// The same under lights a tenth as wide.
std::vector<LineScene> scenes_with_small_lights();

/// With a film of this width, or of its own width if it is 0.
/// \returns nothing if the scene is a published one and NUSSELT_SCENES is not set
/// \throws std::runtime_error if it cannot be loaded
std::optional<scene::Scene> load_line_scene(const LineScene& line_scene, const RunSettings& settings,
                                            int width);

} // namespace nusselt::experiments
