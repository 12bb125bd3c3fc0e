#pragma once
/// A scene in neutral terms, which importers pass to the builder, with the location of each part in its file.

#include "scene/build/built_shape.h"
#include "scene/build/camera.h"
#include "scene/build/geometry.h"
#include "scene/build/lights/emission.h"
#include "scene/build/lights/light_source.h"
#include "scene/build/lights/shown_images.h"
#include "scene/build/limits.h"
#include "scene/build/textures/texture_plan.h"
#include "scene/input/named_files.h"
#include "scene/model/transform.h"

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace nusselt::scene {

/// The material index of shapes without a material. Their surfaces are black.
constexpr int kNoMaterial = -1;

/// A shape with its transform, material and emission.
struct ShapeDescription {
    /// Its name in messages and in the names of lights, such as "sphere"; a constant of the importer.
    std::string_view kind;
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

/// Shapes of the world: one as it was read, or several in a row that are built already.
using WorldPart = std::variant<ShapeDescription, BuiltShape>;

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
    /// Adds a shape to the world. Builds long rows of shapes that do not depend on others, because files may have a
    /// million small ones, whose descriptions take several times the memory. Throws SceneError if one cannot be built.
    void add_shape(ShapeDescription shape);

    std::unique_ptr<SceneBudget> budget = std::make_unique<SceneBudget>();
    std::unique_ptr<ShownImages> images = std::make_unique<ShownImages>(); ///< that its lights show
    std::deque<SourceFile> sources; ///< the files that locations refer to, the main file first
    FormatWords words;
    std::deque<WorldPart> world; ///< see add_shape()
    std::vector<LightSourceDescription> light_sources;
    std::size_t shapes_in_row = 0; ///< at the end of `world`: those that could be built now
    std::vector<ObjectDescription> objects;
    std::vector<InstanceDescription> instances;
    std::vector<Material> materials; ///< their textures are indices into the requests of `textures`
    TexturePlan textures;
    CameraDescription camera;
    Film film;
    Warnings warnings;
    NamedFiles
        named_files; ///< the importer notes its own; the builder adds others, and reports all missing ones
};

} // namespace nusselt::scene
