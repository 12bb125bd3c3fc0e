#pragma once
/// Scenes that line samples are measured in.

#include "lab/report/run_settings.h"
#include "scene/model/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

enum class SceneOrigin {
    shipped,
    published, ///< below the folder that the environment variable NUSSELT_SCENES names
};

struct LineScene {
    std::string name; ///< in tables and names of files
    std::string file;
    std::string rig = {}; ///< below scenes/rigs; empty: none
    SceneOrigin origin = SceneOrigin::shipped;
};

/// The grid, the logo, the soup and Sponza under lights that are a metre wide or more.
std::vector<LineScene> scenes_with_large_lights();

/// The same under lights a tenth as wide.
std::vector<LineScene> scenes_with_small_lights();

/// The name that the paper gives to a scene: "Grid planes, small" for "grid-planes, small".
std::string published_name(const std::string& scene);

/// Loads a scene with a film of this width, or of its own width if the width is 0.
/// \returns nothing if the scene is a published one and NUSSELT_SCENES is not set
/// \throws std::runtime_error if it cannot be loaded
std::optional<scene::Scene> load_line_scene(const LineScene& line_scene, const RunSettings& settings,
                                            int width);

/// Loads one scene after the other.
/// \tparam Result  has `scene`, for the name, and `is_skipped`, for scenes that are not there
/// \param progress called with what is skipped
/// \param run      of a LineScene and its scene; returns the Result
/// \throws std::runtime_error if one cannot be loaded
template <class Result, class Run>
std::vector<Result> for_each_scene(const std::vector<LineScene>& scenes, const RunSettings& settings,
                                   int width, const ProgressText& progress, const Run& run) {
    std::vector<Result> results;
    for (const LineScene& line_scene : scenes) {
        if (const auto scene = load_line_scene(line_scene, settings, width)) {
            results.push_back(run(line_scene, *scene));
            continue;
        }
        progress(line_scene.name + " is skipped; set NUSSELT_SCENES to the folder with this scene");
        Result& skipped = results.emplace_back();
        skipped.scene = line_scene.name;
        skipped.is_skipped = true;
    }
    return results;
}

} // namespace nusselt::lab
