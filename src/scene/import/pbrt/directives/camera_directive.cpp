#include "scene/import/pbrt/directives/camera_directive.h"

namespace nusselt::scene {

namespace {

double read_field_of_view(ParameterList& parameters) {
    const auto half = parameters.optional_real("halffov");
    const double degrees = parameters.real("fov", 90);
    const double result = half ? 2 * *half : degrees;
    if (!(result > 0 && result < 180))
        throw SceneError(parameters.location_of(half ? "halffov" : "fov"),
                         "camera: fov must lie between 0 and 180 degrees, found " + to_text(result));
    return result;
}

} // namespace

CameraDescription read_camera(std::string_view type, ParameterList& parameters,
                              const Transform& camera_from_world, Warnings& warnings) {
    const Location location = parameters.location();
    CameraDescription camera;
    camera.origin = location;
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
                             "camera: screenwindow must be x min, x max, y min, y max");
        camera.screen_window = {window[0], window[1], window[2], window[3]};
    }
    if (parameters.real("lensradius", 0) > 0)
        warnings.add(parameters.location_of("lensradius"),
                     "camera: lensradius is ignored; everything is in focus");
    parameters.ignore({"focaldistance", "shutteropen", "shutterclose"});
    parameters.warn_unused("Camera", warnings);
    return camera;
}

} // namespace nusselt::scene
