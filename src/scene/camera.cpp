#include "scene/camera.h"

#include <cmath>
#include <numbers>

namespace nusselt::scene {

CameraDirective read_camera(std::string_view type, ParameterList& parameters,
                            const Transform& camera_from_world, Warnings& warnings) {
    const Location location = parameters.location();
    if (type != "perspective")
        throw SceneError(location,
                         "camera \"" + std::string(type) + "\" is not supported; use \"perspective\"");
    CameraDirective camera;
    camera.location = location;
    camera.camera_from_world = camera_from_world;
    camera.fov_degrees = parameters.real("fov", 90);
    if (const auto half = parameters.optional_real("halffov")) camera.fov_degrees = 2 * *half;
    if (!(camera.fov_degrees > 0 && camera.fov_degrees < 180))
        throw SceneError(parameters.location_of("fov"),
                         "camera: fov must lie between 0 and 180 degrees, found " +
                             to_text(camera.fov_degrees));
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
                     "camera: lensradius is ignored, the camera is a pinhole");
    parameters.ignore({"focaldistance", "shutteropen", "shutterclose"});
    parameters.warn_unused("Camera", warnings);
    return camera;
}

Film read_film(std::string_view type, ParameterList& parameters, Warnings& warnings) {
    const bool is_v3 = type == "image";
    if (!is_v3 && type != "rgb")
        warnings.add(parameters.location(), "film \"" + std::string(type) + "\" is treated like \"rgb\"");
    Film film;
    film.width = parameters.integer("xresolution", is_v3 ? 640 : 1280);
    film.height = parameters.integer("yresolution", is_v3 ? 480 : 720);
    constexpr int kMaxResolution = 65536;
    for (const auto& [name, value] : {std::pair{"xresolution", film.width}, {"yresolution", film.height}})
        if (value < 1 || value > kMaxResolution)
            throw SceneError(parameters.location_of(name),
                             "film: " + std::string(name) + " must lie between 1 and " +
                                 std::to_string(kMaxResolution) + ", found " + std::to_string(value));
    film.filename = parameters.string("filename", "");
    parameters.ignore({"diagonal", "savefp16"});
    parameters.warn_unused("Film", warnings);
    return film;
}

Camera make_camera(const CameraDirective& directive, const Film& film) {
    const auto world_from_camera = inverse(directive.camera_from_world);
    if (!world_from_camera) throw SceneError(directive.location, "camera: its transform cannot be inverted");

    const double aspect = directive.aspect_ratio.value_or(static_cast<double>(film.width) / film.height);
    const std::array<double, 4> window =
        directive.screen_window.value_or(aspect > 1 ? std::array<double, 4>{-aspect, aspect, -1, 1}
                                                    : std::array<double, 4>{-1, 1, -1 / aspect, 1 / aspect});
    const double scale = std::tan(directive.fov_degrees * (std::numbers::pi / 360));
    const auto world = [&](double x, double y, double z) {
        return to_float(transform_vector(*world_from_camera, {x, y, z}));
    };
    Camera camera;
    camera.origin = to_float(transform_point(*world_from_camera, {0, 0, 0}));
    camera.corner = world(scale * window[0], scale * window[3], 1);
    camera.right = world(scale * (window[1] - window[0]) / film.width, 0, 0);
    camera.down = world(0, scale * (window[2] - window[3]) / film.height, 0);
    if (!is_valid_coordinate(camera.origin))
        throw SceneError(directive.location, "camera: its position lies more than 1e15 m from the origin");
    return camera;
}

} // namespace nusselt::scene
