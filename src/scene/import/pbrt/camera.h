#pragma once
/// pbrt's camera directive.

#include "scene/import/pbrt/syntax/parameters.h"
#include "scene/model/transform.h"

#include <array>
#include <optional>

namespace nusselt::scene {

enum class CameraKind { perspective, orthographic };

/// What a Camera directive says, before the film is known.
struct CameraDirective {
    Location location;
    CameraKind kind = CameraKind::perspective;
    Transform camera_from_world;
    double fov_degrees = 90;                            ///< of the shorter image axis; perspective only
    std::optional<double> aspect_ratio;                 ///< width / height; default: that of the film
    std::optional<std::array<double, 4>> screen_window; ///< x min, x max, y min, y max
};

CameraDirective read_camera(std::string_view type, ParameterList& parameters,
                            const Transform& camera_from_world, Warnings& warnings);

/// Rays in world space for raster positions. Throws SceneError if the transform cannot be inverted.
Camera make_camera(const CameraDirective& directive, const Film& film);

} // namespace nusselt::scene
