#pragma once
/// Makes tubes and lines that emit an image.

#include "scene/build/build_shape.h"

namespace nusselt::scene {

/// Adds a tube whose radiance varies along its axis. The rows of the image go from its start (v = 0) to its end. Where
/// radiance varies around the axis, or there are more rows than kMaxLineTexels, means take its place, with a warning.
/// \param light all but its radiance and texture
void add_textured_tube(const ShapeDescription& shape, const FormatWords& words, LineLight light,
                       BuiltShape& built);

/// What a tube shows of an image: the means of rows, at most kMaxLineTexels of them.
/// \returns an emission without a texture if all rows are alike
TexturedEmission show_rows(const EmissionTexture& image, const LineLight& light);

} // namespace nusselt::scene
