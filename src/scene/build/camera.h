#pragma once
/// Cameras as importers describe them.

#include "scene/input/diagnostics.h"
#include "scene/model/scene.h"
#include "scene/model/transform.h"

#include <array>
#include <optional>

namespace nusselt::scene {

enum class CameraKind { perspective, orthographic };

/// A camera that looks along +z of its space, with +y up and +x to the right.
struct CameraDescription {
    Location origin;
    CameraKind kind = CameraKind::perspective;
    Transform camera_from_world;
    double fov_degrees = 90;                            ///< along the shorter image axis; perspective only
    std::optional<double> aspect_ratio;                 ///< width / height; default: that of the film
    std::optional<std::array<double, 4>> screen_window; ///< x min, x max, y min, y max
};

/// Rays in world space for raster positions. Throws SceneError if the transform cannot be inverted.
Camera make_camera(const CameraDescription& description, const Film& film);

} // namespace nusselt::scene
