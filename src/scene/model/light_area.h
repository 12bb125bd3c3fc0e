#pragma once
/// Areas of lights, which make radiance of power [m^2].

#include "scene/model/scene.h"

namespace nusselt::scene {

/// The area of one side.
double area(const PolygonLight& light);
/// The area of the lateral surface of a tube.
double lateral_area(const LineLight& light);
/// The area of all that emits: the lateral surface, and the caps of solid tubes.
double area(const LineLight& light);

} // namespace nusselt::scene
