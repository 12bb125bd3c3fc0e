#pragma once
/// Makes the polygonal lights of a shape that emits an image.

#include "scene/build/build_shape.h"
#include "scene/build/lights/shown_images.h"
#include "scene/build/polygons/polygon_merge.h"

#include <cstddef>

namespace nusselt::scene {

/// The most lights with a texture that one shape may have. The polygons of others have the mean of their part of the image.
inline constexpr std::size_t kMaxTexturedPolygons = 1024;

/// Adds the lights of a shape whose emission has a texture. Texture coordinates must be an affine function on each light: a
/// polygon on which they are not is split into its triangles. Where texture coordinates have no area, the light is uniform.
/// \param images of the scene
void add_textured_polygons(const ShapeDescription& shape, const FormatWords& words,
                           PolygonPartition&& partition, ShownImages& images, BuiltShape& built);

} // namespace nusselt::scene
