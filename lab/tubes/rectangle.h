#pragma once
/// Rectangles that strips stand for.

#include "scene/model/lights/line_light.h"
#include "scene/model/lights/polygon_light.h"

namespace nusselt::lab {

/// The rectangle of a strip, bright on both sides.
scene::PolygonLight rectangle_of(const scene::LineLight& strip);

} // namespace nusselt::lab
