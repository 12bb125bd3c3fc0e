#pragma once
/// Shape directives.

#include "scene/build/scene_description.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace nusselt::scene {

/// A Shape directive with the graphics state that applies to it.
struct ShapeDirective {
    std::string type;
    ParameterList parameters;
    std::filesystem::path mesh_path; ///< of type "plymesh"
    Transform world_from_object;
    bool reverse_orientation = false;
    Emission emission;          ///< black for surfaces that do not emit
    int material = kNoMaterial; ///< index in the scene
};

/// Whether read_shape() knows shapes of this type.
bool is_supported(std::string_view type);

/// Whether the shape becomes a surface, which needs a material.
bool is_surface(ShapeDirective& shape);

/// Throws SceneError on parameters that are missing or have impossible values.
ShapeDescription read_shape(ShapeDirective& shape);

} // namespace nusselt::scene
