#pragma once
/// Makes tubes and lines that emit an image.

#include "scene/build/build_shape.h"

namespace nusselt::scene {

/// Adds a tube whose radiance varies along its axis. The rows of the image go from its start (v = 0) to its end. Where
/// radiance varies around the axis, or there are more rows than kMaxLineTexels, means take its place, with a warning.
/// \param light all but its radiance and texture
void add_textured_tube(const ShapeDescription& shape, const FormatWords& words, LineLight light,
                       BuiltShape& built);

} // namespace nusselt::scene
