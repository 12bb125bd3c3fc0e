#pragma once
/// Shape directives and their conversion to triangles and lights in world space.

#include "scene/build/mesh.h"
#include "scene/import/pbrt/emission.h"
#include "scene/import/pbrt/syntax/parameters.h"
#include "scene/model/transform.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nusselt::scene {

/// A Shape directive with the graphics state that applies to it.
struct ShapeDirective {
    std::string type;
    ParameterList parameters;
    std::filesystem::path mesh_path; ///< of type "plymesh"
    Transform world_from_object;
    bool reverse_orientation = false;
    Emission emission;  ///< black for surfaces that do not emit
    int material = -1;  ///< -1 for invisible surfaces; they are needed for tubes only
    int max_sides = 64; ///< pieces around the full circle of round shapes, at most
};

/// Whether build_mesh() knows shapes of this type.
bool is_supported(std::string_view type);

/// Whether the shape becomes a tubular light, which needs no material.
bool is_tube(ShapeDirective& shape);

/// Makes round shapes coarser if there are many, so that they fit into the memory: a line of text must not take much more
/// than it would as a mesh.
void limit_tessellation(std::vector<ShapeDirective>& shapes);

/// Whether pbrt's normal is the reverse of the right-hand normal of the vertices in world space.
bool flips_orientation(const ShapeDirective& shape);

/// Triangles in world space. Those of emitters are oriented such that (v1 - v0) x (v2 - v0) points to the
/// side that emits in pbrt: the side of the shading normals if there are any, else that of the right-hand
/// rule in object space, mirrored by ReverseOrientation and once more by a transform that swaps handedness.
/// Their triangle_light refers to polygon_lights, to which coplanar neighbours have been merged. Throws
/// SceneError. Touches nothing but `shape`, so that shapes may be built in parallel.
Mesh build_mesh(ShapeDirective& shape);

} // namespace nusselt::scene
