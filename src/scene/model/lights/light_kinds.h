#pragma once
/// The table of kinds of light. Another kind is a file in this folder and a row of no_lights_of_each_kind().

#include "scene/model/lights/distant_light.h"
#include "scene/model/lights/environment_light.h"
#include "scene/model/lights/lights.h"
#include "scene/model/lights/line_light.h"
#include "scene/model/lights/point_light.h"
#include "scene/model/lights/polygon_light.h"

namespace nusselt::scene {

/// The only kind whose lights are surfaces: Scene::triangle_light refers to them. Its lights have the lowest numbers.
using SurfaceLight = PolygonLight;

/// An empty list for each kind. Lights are numbered in this order.
Lights no_lights_of_each_kind();

} // namespace nusselt::scene
