#pragma once
/// Spheres and ellipsoids around the camera that shine outwards: the camera sees their dark side only.

#include "scene/build/lights/emission_warnings.h"
#include "scene/input/diagnostics.h"
#include "scene/model/scene.h"

#include <cstddef>

namespace nusselt::scene {

/// Whether the camera is inside of a round light that shines outwards only.
bool surrounds_camera(const Scene& scene, const RoundLight& light);

/// Why the camera sees no light of a round light: the light surrounds it. Nothing for lights without a surface, or with one that
/// is only partly there: rays pass it and meet what the light illuminates outside.
/// \param index among the round lights of the scene
Darkness darkness_inside(const Scene& scene, std::size_t index);

/// Warns of each such light.
void warn_of_surrounding_lights(const Scene& scene, Warnings& warnings);

} // namespace nusselt::scene
