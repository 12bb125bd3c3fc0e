#pragma once
/// pbrt's camera and film directives.

#include "scene/parameters.h"
#include "scene/transform.h"

#include <array>
#include <optional>

namespace nusselt::scene {

/// What a Camera directive says, before the film is known.
struct CameraDirective {
    Location location;
    Transform camera_from_world;
    double fov_degrees = 90;                            ///< of the shorter image axis
    std::optional<double> aspect_ratio;                 ///< width / height; default: that of the film
    std::optional<std::array<double, 4>> screen_window; ///< x min, x max, y min, y max
};

CameraDirective read_camera(std::string_view type, ParameterList& parameters,
                            const Transform& camera_from_world, Warnings& warnings);

/// Defaults are 640x480 for pbrt v3's film "image", 1280x720 for those of v4.
Film read_film(std::string_view type, ParameterList& parameters, Warnings& warnings);

/// Rays in world space for raster positions. Throws SceneError if the transform cannot be inverted.
Camera make_camera(const CameraDirective& directive, const Film& film);

} // namespace nusselt::scene
