#pragma once
/// Builds one shape at one place: its triangles and lights.

#include "scene/build/built_shape.h"
#include "scene/build/lights/shown_images.h"
#include "scene/build/placed_shape.h"

#include <string>

namespace nusselt::scene {

/// Whether the builder turns such a shape into a surface, which needs a material, and not into a light that is none.
bool becomes_surface(const Geometry& geometry, const Emission& emission, const Transform& world_from_object);

/// The beginning of messages about a shape.
std::string subject_of(const ShapeDescription& shape);

/// Makes triangles in world space. Those of emitters are oriented such that (v1 - v0) x (v2 - v0) points to the side that emits:
/// the side of the shading normals if there are any, else that of the right-hand rule in the space of the shape,
/// mirrored by `reverse_orientation` and once more by a transform that swaps handedness. Their triangle_light refers to
/// polygons, into which coplanar neighbours are merged. Takes the arrays of the shape unless others share them.
/// Throws SceneError. Changes nothing but this shape, so that shapes may be built in parallel.
/// \param images of the scene
BuiltShape build_shape(const PlacedShape& placed, SceneBudget& budget, const FormatWords& words,
                       ShownImages& images);

} // namespace nusselt::scene
