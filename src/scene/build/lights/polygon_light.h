#pragma once
/// Makes the polygonal lights of the model from the triangles of shapes that emit.

#include "scene/build/build_shape.h"

namespace nusselt::scene {

/// Orients the triangles of an emissive shape in world space to the side that emits, and merges them into polygons.
/// Removes the triangles if the shape is invisible.
void add_polygon_lights(const ShapeDescription& shape, const FormatWords& words, ShownImages& images,
                        BuiltShape& built);

/// Removes the triangles of an invisible shape, which keeps its lights.
void remove_surface(BuiltShape& built);

} // namespace nusselt::scene
