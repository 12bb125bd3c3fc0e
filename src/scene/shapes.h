#pragma once
/// Shape directives and their conversion to triangles and lights in world space.

#include "scene/mesh.h"
#include "scene/parameters.h"
#include "scene/transform.h"

#include <filesystem>
#include <string>

namespace nusselt::scene {

/// An AreaLightSource directive.
struct Emission {
    Float3 radiance = {0, 0, 0};
    bool two_sided = false;
};

/// A Shape directive with the graphics state that applies to it.
struct ShapeDirective {
    std::string type;
    ParameterList parameters;
    std::filesystem::path mesh_path; ///< of type "plymesh"
    Transform world_from_object;
    bool reverse_orientation = false;
    Emission emission; ///< black for surfaces that do not emit
    int material = -1; ///< -1 for invisible surfaces; they are needed for tubes only
};

inline bool is_black(const Float3& c) { return c.x == 0 && c.y == 0 && c.z == 0; }

/// Whether build_mesh() knows shapes of this type and emission.
bool is_supported(const ShapeDirective& shape);

/// Whether a type of shape is a tubular light, which needs no material.
bool is_tube(std::string_view type);

/// Triangles in world space. Those of emitters are oriented such that (v1 - v0) x (v2 - v0) points to the
/// side that emits in pbrt: the side of the shading normals if there are any, else that of the right-hand
/// rule in object space, mirrored by ReverseOrientation and once more by a transform that swaps handedness.
/// Their triangle_light refers to polygon_lights, to which coplanar neighbours have been merged. Throws
/// SceneError. Touches nothing but `shape`, so that shapes may be built in parallel.
Mesh build_mesh(ShapeDirective& shape);

} // namespace nusselt::scene
