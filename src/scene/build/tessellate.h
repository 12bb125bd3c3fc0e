#pragma once
/// Divides round and curved shapes into flat pieces; docs/materials.md defines how many.

#include "scene/build/build_shape.h"

namespace nusselt::scene {

// Make triangles in the coordinates of the shape. Those of surfaces of revolution have the area of the original, and
// SceneError reports an area of zero. Flat patches keep their shape.
Mesh tessellate(const Sphere& sphere, const PlacedShape& placed, Warnings& warnings);
Mesh tessellate(const Disk& disk, const PlacedShape& placed, Warnings& warnings);
Mesh tessellate(const Cylinder& cylinder, const PlacedShape& placed, Warnings& warnings);
Mesh tessellate(const BilinearPatches& patches, const PlacedShape& placed, Warnings& warnings);

/// Whether no patch is curved.
bool are_planar(const BilinearPatches& patches);

} // namespace nusselt::scene
