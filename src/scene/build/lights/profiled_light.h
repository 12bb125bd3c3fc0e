#pragma once
/// Makes the lights of a shape whose radiance depends on the direction.

#include "scene/build/build_shape.h"
#include "scene/build/polygons/polygon_merge.h"

namespace nusselt::scene {

/// The emission of shapes that cannot have its profile: as much light, alike in all directions.
Emission without_profile(const Emission& emission);

/// Says that a shape emits alike in all directions instead.
void warn_of_too_many_normals(const ShapeDescription& shape, Warnings& warnings);

/// Adds the lights of a shape whose emission has a profile. Shapes with too many normals emit alike in all directions, with a
/// warning. Another warning tells what a shape cannot emit of the flux of its luminaire.
void add_profiled_polygons(const ShapeDescription& shape, const FormatWords& words,
                           PolygonPartition&& partition, BuiltShape& built);

/// Adds a tube, a line or a strip whose emission has a luminaire or a spread. Honeycombs have no effect.
/// \param light all but its radiance, with a normal
void add_profiled_line(const ShapeDescription& shape, const FormatWords& words, LineLight light,
                       BuiltShape& built);

} // namespace nusselt::scene
