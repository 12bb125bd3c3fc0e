#include "scene/build/camera.h"

#include "scene/model/vector_math.h"

#include <cmath>
#include <numbers>

namespace nusselt::scene {

namespace {

/// Directions are normalised in float.
constexpr double kMaxScale = 1e6;

/// The corners of the image in camera space: screen coordinates at distance 1 or, for parallel rays, at the camera.
std::array<double, 4> screen_window(const CameraDescription& description, const Film& film) {
    if (description.screen_window) return *description.screen_window;
    const double aspect = description.aspect_ratio.value_or(static_cast<double>(film.width) / film.height);
    return aspect > 1 ? std::array<double, 4>{-aspect, aspect, -1, 1}
                      : std::array<double, 4>{-1, 1, -1 / aspect, 1 / aspect};
}

} // namespace

Camera make_camera(const CameraDescription& description, const Film& film) {
    const auto world_from_camera = inverse(description.camera_from_world);
    if (!world_from_camera) throw SceneError(description.origin, "camera: the transform is not invertible");
    for (const Double3& axis : {Double3{1, 0, 0}, Double3{0, 1, 0}, Double3{0, 0, 1}}) {
        const double factor = length(transform_vector(*world_from_camera, axis));
        if (!(factor >= 1 / kMaxScale && factor <= kMaxScale))
            throw SceneError(description.origin, "camera: the transform scales by " + to_text(1 / factor) +
                                                     ", which must lie between 1e-6 and 1e6");
    }

    const std::array<double, 4> window = screen_window(description, film);
    const bool is_perspective = description.kind == CameraKind::perspective;
    const double scale = is_perspective ? std::tan(description.fov_degrees * (std::numbers::pi / 360)) : 1;
    const auto vector = [&](double x, double y, double z) {
        return to_float(transform_vector(*world_from_camera, {x, y, z}));
    };
    const auto point = [&](double x, double y) {
        return to_float(transform_point(*world_from_camera, {x, y, 0}));
    };
    const Float3 right = vector(scale * (window[1] - window[0]) / film.width, 0, 0);
    const Float3 down = vector(0, scale * (window[2] - window[3]) / film.height, 0);
    Camera camera;
    if (is_perspective) {
        camera.origin = point(0, 0);
        camera.corner = vector(scale * window[0], scale * window[3], 1);
        camera.right = right;
        camera.down = down;
    } else {
        camera.origin = point(window[0], window[3]);
        camera.origin_right = right;
        camera.origin_down = down;
        camera.corner = vector(0, 0, 1);
        camera.right = {0, 0, 0};
        camera.down = {0, 0, 0};
    }
    if (!is_valid_coordinate(camera.origin))
        throw SceneError(description.origin, "camera: the position must be within 1e15 m of the origin");
    for (const Float3& v : {camera.corner, right, down})
        if (!is_valid_coordinate(v))
            throw SceneError(description.origin, "camera: the screen window exceeds 1e15");
    return camera;
}

} // namespace nusselt::scene
