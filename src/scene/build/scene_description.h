#pragma once
/// A scene in neutral terms, which importers pass to the builder, with the location of each part in its file.

#include "scene/build/camera.h"
#include "scene/build/emission.h"
#include "scene/build/geometry.h"
#include "scene/build/limits.h"
#include "scene/build/textures/texture_plan.h"
#include "scene/model/transform.h"

#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace nusselt::scene {

/// The material index of shapes without a material. Their surfaces are black.
constexpr int kNoMaterial = -1;

/// A shape with its transform, material and emission.
struct ShapeDescription {
    std::string kind; ///< its name in messages and in the names of lights, such as "sphere"
    Location origin;
    Geometry geometry;
    Transform world_from_object;
    /// Whether the shape emits to the other side, where its shading normals point then.
    bool reverse_orientation = false;
    Emission emission;         ///< black for surfaces that do not emit
    bool is_invisible = false; ///< for a shape that emits: it has a light but no surface
    int material =
        kNoMaterial;   ///< index into SceneDescription::materials; lights that are no surfaces need none
    Warnings warnings; ///< of the importer; those of the builder come first
};

/// Shapes that instances share.
struct ObjectDescription {
    std::string name;
    std::vector<ShapeDescription> shapes;
};

struct InstanceDescription {
    std::size_t object = 0; ///< index into SceneDescription::objects
    Transform world_from_object;
    Location origin;
};

/// The words of a format for the parts of a scene, for messages.
struct FormatWords {
    std::string instance = "instance";
    std::string emission = "emission";
    std::string reversal = "reversal"; ///< of the orientation of a shape
};

/// A scene as an importer read it. The builder reads images, and meshes in files of their own.
struct SceneDescription {
    std::unique_ptr<SceneBudget> budget = std::make_unique<SceneBudget>();
    std::deque<SourceFile> sources; ///< the files that locations refer to, the main file first
    FormatWords words;
    std::vector<ShapeDescription> shapes; ///< the shapes of the world
    std::vector<ObjectDescription> objects;
    std::vector<InstanceDescription> instances;
    std::vector<Material> materials; ///< their textures are indices into the requests of `textures`
    TexturePlan textures;
    CameraDescription camera;
    Film film;
    Warnings warnings;
};

} // namespace nusselt::scene
