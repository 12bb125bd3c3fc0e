#pragma once
/// Makes the tubular lights of the model from tubes and from cylinders that emit.

#include "scene/build/build_shape.h"

namespace nusselt::scene {

/// Whether a shape at this place is a tubular light: tubes are, and cylinders that emit and stay round.
bool becomes_tube(const Geometry& geometry, const Emission& emission, const Transform& world_from_object);

/// Makes a tubular light in world space and no surface. Leaves out tubes that do not emit, with a warning.
BuiltShape build_tube(const PlacedShape& placed, const FormatWords& words);

} // namespace nusselt::scene
