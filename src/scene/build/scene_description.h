#pragma once
/// A scene in neutral terms, which importers pass to the builder, with the place in the file of each part.

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

/// Index of the material of shapes that have none. Their surfaces are black.
constexpr int kNoMaterial = -1;

/// A shape with all that applies to it.
struct ShapeDescription {
    std::string kind; ///< its name in messages and in the names of lights, such as "sphere"
    Location origin;
    Geometry geometry;
    Transform world_from_object;
    /// Whether the shape emits to the other side, and shading normals point there.
    bool reverse_orientation = false;
    Emission emission;         ///< black for surfaces that do not emit
    bool is_invisible = false; ///< of a shape that emits: only its light is there, cameras see no surface
    int material =
        kNoMaterial;   ///< index into SceneDescription::materials; lights that are no surfaces need none
    Warnings warnings; ///< of the importer; those of the builder come before
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

/// The words of a format for the parts of a scene. Messages use the same words.
struct FormatWords {
    std::string instance = "instance";
    std::string emission = "emission";
    std::string reversal = "reversal"; ///< of the orientation of a shape
};

/// A scene as an importer read it; meshes in files of their own and images are still to be read.
struct SceneDescription {
    std::unique_ptr<SceneBudget> budget = std::make_unique<SceneBudget>();
    std::deque<SourceFile> sources; ///< all locations point into these; the first one is the main file
    FormatWords words;
    std::vector<ShapeDescription> shapes; ///< the shapes of the world
    std::vector<ObjectDescription> objects;
    std::vector<InstanceDescription> instances;
    std::vector<Material> materials; ///< their textures are indices of requests of `textures`
    TexturePlan textures;
    CameraDescription camera;
    Film film;
    Warnings warnings;
};

} // namespace nusselt::scene
