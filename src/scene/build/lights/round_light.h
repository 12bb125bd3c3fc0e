#pragma once
/// Makes the round lights of the model from spheres and disks that emit.

#include "scene/build/build_shape.h"

#include <string_view>

namespace nusselt::scene {

/// Whether a shape at this place is a round light: whole spheres and disks that emit, unless they are far flatter or longer than
/// wide, or their transform has perspective. Disks that emit an image or have a profile become polygons instead, and so do spheres
/// that emit an image.
bool becomes_round_light(const Geometry& geometry, const Emission& emission,
                         const Transform& world_from_object);

/// Why a sphere or disk that emits does not become a round light, as a clause.
std::string_view why_not_round(const Geometry& geometry, const Emission& emission,
                               const Transform& world_from_object);

/// Makes a round light and its surface in world space. \param placed a shape that becomes one
BuiltShape build_round_light(const PlacedShape& placed, const FormatWords& words);

} // namespace nusselt::scene
