#pragma once
/// Areas of lights, which make radiance of power [m^2].

#include "scene/build/mesh.h"

namespace nusselt::scene {

/// Of one side.
double area(const PolygonLight& light);
/// Of the sides of all triangles to which they are oriented.
double area(const Mesh& mesh);
/// Of the mantle of a tube.
double mantle_area(const LineLight& light);
/// Of all that emits: the mantle, and the caps of solid tubes.
double area(const LineLight& light);

} // namespace nusselt::scene
