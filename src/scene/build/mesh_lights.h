#pragma once
/// Polygonal lights of emissive meshes.

#include "scene/import/pbrt/shapes.h"

namespace nusselt::scene {

/// Orients the triangles of an emissive shape in world space to the side that emits, and merges them to polygon_lights.
/// If the shape has an alpha of 0, the light is invisible: its triangles are removed.
void add_polygon_lights(ShapeDirective& shape, Mesh& mesh);

} // namespace nusselt::scene
