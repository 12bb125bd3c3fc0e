#include "scene/import/pbrt/camera.h"

#include <cmath>
#include <numbers>

namespace nusselt::scene {

namespace {

/// Directions are normalised in float.
constexpr double kMaxScale = 1e6;

double read_field_of_view(ParameterList& parameters) {
    const auto half = parameters.optional_real("halffov");
    const double degrees = parameters.real("fov", 90);
    const double result = half ? 2 * *half : degrees;
    if (!(result > 0 && result < 180))
        throw SceneError(parameters.location_of(half ? "halffov" : "fov"),
                         "camera: fov must lie between 0 and 180 degrees, found " + to_text(result));
    return result;
}

/// Corners of the image in camera space: pbrt's screen coordinates at distance 1 or, for parallel rays, at the camera.
std::array<double, 4> screen_window(const CameraDirective& directive, const Film& film) {
    if (directive.screen_window) return *directive.screen_window;
    const double aspect = directive.aspect_ratio.value_or(static_cast<double>(film.width) / film.height);
    return aspect > 1 ? std::array<double, 4>{-aspect, aspect, -1, 1}
                      : std::array<double, 4>{-1, 1, -1 / aspect, 1 / aspect};
}

} // namespace

CameraDirective read_camera(std::string_view type, ParameterList& parameters,
                            const Transform& camera_from_world, Warnings& warnings) {
    const Location location = parameters.location();
    CameraDirective camera;
    camera.location = location;
    camera.camera_from_world = camera_from_world;
    if (type == "orthographic")
        camera.kind = CameraKind::orthographic;
    else if (type != "perspective")
        throw SceneError(location, "camera \"" + shortened(type) +
                                       "\" is not supported; use \"perspective\" or \"orthographic\"");
    if (camera.kind == CameraKind::perspective) camera.fov_degrees = read_field_of_view(parameters);
    camera.aspect_ratio = parameters.optional_real("frameaspectratio");
    if (camera.aspect_ratio && !(*camera.aspect_ratio > 0))
        throw SceneError(parameters.location_of("frameaspectratio"),
                         "camera: frameaspectratio must be positive, found " + to_text(*camera.aspect_ratio));
    if (const auto window = parameters.reals("screenwindow"); !window.empty()) {
        if (window.size() != 4 || window[0] == window[1] || window[2] == window[3])
            throw SceneError(parameters.location_of("screenwindow"),
                             "camera: screenwindow takes x min, x max, y min, y max");
        camera.screen_window = {window[0], window[1], window[2], window[3]};
    }
    if (parameters.real("lensradius", 0) > 0)
        warnings.add(parameters.location_of("lensradius"),
                     "camera: lensradius is ignored, everything is in focus");
    parameters.ignore({"focaldistance", "shutteropen", "shutterclose"});
    parameters.warn_unused("Camera", warnings);
    return camera;
}

Camera make_camera(const CameraDirective& directive, const Film& film) {
    const auto world_from_camera = inverse(directive.camera_from_world);
    if (!world_from_camera) throw SceneError(directive.location, "camera: its transform cannot be inverted");
    for (const Double3& axis : {Double3{1, 0, 0}, Double3{0, 1, 0}, Double3{0, 0, 1}}) {
        const double factor = length(transform_vector(*world_from_camera, axis));
        if (!(factor >= 1 / kMaxScale && factor <= kMaxScale))
            throw SceneError(directive.location, "camera: its transform scales by " + to_text(1 / factor) +
                                                     ", which must lie between 1e-6 and 1e6");
    }

    const std::array<double, 4> window = screen_window(directive, film);
    const bool is_perspective = directive.kind == CameraKind::perspective;
    const double scale = is_perspective ? std::tan(directive.fov_degrees * (std::numbers::pi / 360)) : 1;
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
        throw SceneError(directive.location, "camera: its position lies more than 1e15 m from the origin");
    for (const Float3& v : {camera.corner, right, down})
        if (!is_valid_coordinate(v))
            throw SceneError(directive.location, "camera: its screen window exceeds 1e15");
    return camera;
}

} // namespace nusselt::scene
