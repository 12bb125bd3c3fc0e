#pragma once
/// Directives of a scene file: graphics state, options, lists of what the file describes.

#include "scene/import/pbrt/camera.h"
#include "scene/import/pbrt/film.h"
#include "scene/import/pbrt/materials.h"
#include "scene/import/pbrt/objects.h"
#include "scene/import/pbrt/shapes.h"
#include "scene/import/pbrt/textures.h"

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace nusselt::scene {

/// A scene file after parsing; meshes and images are still to be read.
struct SceneDescription {
    std::unique_ptr<SceneBudget> budget = std::make_unique<SceneBudget>(); ///< parameters refer to it
    std::deque<SourceFile> sources;                                        ///< all locations point into these
    std::vector<ShapeDirective> shapes; ///< those of the world first, then those of objects
    std::vector<ObjectShapes> objects;  ///< in the order of their shapes
    std::vector<InstanceDirective> instances;
    std::vector<Material> materials; ///< used ones; their textures are indices of requests of `textures`
    TexturePlan textures;
    CameraDirective camera;
    Film film;
    Warnings warnings;
};

/// Reads a scene file and what it includes. Throws SceneError, or std::runtime_error if `path` cannot be
/// read.
SceneDescription parse_scene(const std::filesystem::path& path);

} // namespace nusselt::scene
