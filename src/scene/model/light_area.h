#pragma once
/// Areas of lights, which make radiance of power [m^2].

#include "scene/model/scene.h"

namespace nusselt::scene {

/// Of one side.
double area(const PolygonLight& light);
/// Of the lateral surface of a tube.
double lateral_area(const LineLight& light);
/// Of all that emits: the lateral surface, and the caps of solid tubes.
double area(const LineLight& light);

} // namespace nusselt::scene
