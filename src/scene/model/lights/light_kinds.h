#pragma once
/// The table of kinds of light. Another kind is a file in this folder and a row of no_lights_of_each_kind().

#include "scene/model/lights/distant_light.h"
#include "scene/model/lights/environment_light.h"
#include "scene/model/lights/lights.h"
#include "scene/model/lights/line_light.h"
#include "scene/model/lights/point_light.h"
#include "scene/model/lights/polygon_light.h"
#include "scene/model/lights/round/round_light.h"

#include <cstddef>

namespace nusselt::scene {

/// How many lights are surfaces, to which Scene::triangle_light refers. They have the lowest numbers.
inline std::size_t surface_light_count(const Lights& lights) {
    return lights.of<PolygonLight>().size() + lights.of<RoundLight>().size();
}

/// An empty list for each kind. Lights are numbered in this order.
Lights no_lights_of_each_kind();

} // namespace nusselt::scene
