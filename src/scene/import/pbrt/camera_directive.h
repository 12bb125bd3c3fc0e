#pragma once
/// pbrt's camera directive.

#include "scene/build/camera.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <string_view>

namespace nusselt::scene {

/// What a Camera directive says, before the film is known. Throws SceneError at values that are impossible.
CameraDescription read_camera(std::string_view type, ParameterList& parameters,
                              const Transform& camera_from_world, Warnings& warnings);

} // namespace nusselt::scene
