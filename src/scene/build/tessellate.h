#pragma once
/// Round and curved shapes as flat pieces: as many as docs/materials.md defines.

#include "scene/build/build_shape.h"

namespace nusselt::scene {

// Triangles in the coordinates of the shape. Those of surfaces of revolution have the area of the original; SceneError says
// so if that is zero. Flat patches stay as they are.
Mesh tessellate(const Sphere& sphere, const PlacedShape& placed, Warnings& warnings);
Mesh tessellate(const Disk& disk, const PlacedShape& placed, Warnings& warnings);
Mesh tessellate(const Cylinder& cylinder, const PlacedShape& placed, Warnings& warnings);
Mesh tessellate(const BilinearPatches& patches, const PlacedShape& placed, Warnings& warnings);

} // namespace nusselt::scene
