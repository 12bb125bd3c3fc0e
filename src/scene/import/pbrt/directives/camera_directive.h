#pragma once
/// pbrt's camera directive.

#include "scene/build/camera.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <string_view>

namespace nusselt::scene {

/// Reads a Camera directive before the film is known. Throws SceneError for invalid values.
CameraDescription read_camera(std::string_view type, ParameterList& parameters,
                              const Transform& camera_from_world, Warnings& warnings);

} // namespace nusselt::scene
