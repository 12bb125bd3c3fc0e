#include "viewer.h"

#include "image/io.h"
#include "scene/colour/colour_space.h"
#include "scene/model/bounds.h"
#include "scene/rig/rig_json.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <utility>

namespace nusselt::viewer {

namespace {

scene::Scene without_crop(scene::Scene scene) {
    scene.film.crop.reset();
    return scene;
}

scene::Double3 middle_of(const scene::Scene& scene) {
    const scene::Bounds box = scene_bounds(scene);
    return 0.5 * (box.low + box.high);
}

// As fractions of the radius of the scene.
constexpr double kNearestNewLight = 0.2; ///< distance from the camera
constexpr double kSizeOfNewLight = 0.2;

} // namespace

Viewer::Viewer(const gpu::Device& device, const scene::Scene& loaded, render_vulkan::ShadowRays shadow_rays,
               const render::RenderSettings& settings, const SceneFiles& scene_files)
    : session(device, without_crop(loaded), shadow_rays),
      state{.camera = FlyCamera(loaded.camera, loaded.film.width, loaded.film.height),
            .settings = {settings, settings}},
      files(scene_files),
      last_state_(state) {}

void Viewer::next_frame(double seconds) {
    using Clock = std::chrono::steady_clock;
    // Frames that are interrupted would never be finished while something moves.
    if (is_moving) {
        seconds = std::numeric_limits<double>::infinity();
        frame_seconds_ = 0;
    }
    state.reduction = pace_.reduction(std::exchange(is_moving, false));
    const auto begin = Clock::now();
    try {
        is_frame_finished = session.render(state, seconds);
        session.show(state);
    } catch (const gpu::Error&) {
        throw;
    } catch (const std::exception& error) {
        message = error.what();
        if (state.edits != last_state_.edits) history_.forget(state.edits);
        state = last_state_;
        session.render(state);
        session.show(state);
        is_frame_finished = true;
        return;
    }
    frame_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
    if (is_frame_finished) pace_.note(state.reduction, std::exchange(frame_seconds_, 0));
    if (state.edits != last_state_.edits) message.clear();
    last_state_ = state;
}

void Viewer::add_light(LightShape shape) {
    const scene::Scene& scene = session.loaded();
    const FlyCamera& camera = state.camera;
    // As far away as the middle of the scene.
    const scene::Double3 way = middle_of(scene) - camera.position();
    const double distance = std::max(dot(way, camera.forward()), kNearestNewLight * scene.radius);
    NewLight light;
    light.shape = shape;
    light.name = "new " + std::string(name_of(shape));
    light.center = camera.position() + distance * camera.forward();
    light.direction = shape == LightShape::tube ? normalized(camera.right()) : -1.0 * camera.up();
    light.size = kSizeOfNewLight * scene.radius;
    const bool has_radiance = !scene.emitters.empty() && state.edits.quantity(scene, 0) == scene::kRadiance;
    const double brightness = has_radiance ? luminance(to_double(state.edits.emission_before(scene, 0))) : 1;
    light.radiance = to_float(brightness * scene::Double3{1, 1, 1});
    state.selected_light = state.edits.add(scene, light);
    finish_edit();
}

void Viewer::remove_selected_light() {
    if (!state.selected_light) throw std::invalid_argument("no light is selected; select one first");
    state.edits.remove(*state.selected_light);
    state.selected_light.reset();
    finish_edit();
}

void Viewer::show_edits(const LightEdits& edits) {
    state.edits = edits;
    if (state.selected_light && !edits.has(session.loaded(), *state.selected_light))
        state.selected_light.reset();
}

void Viewer::undo() {
    finish_edit();
    if (history_.can_undo())
        show_edits(history_.undo());
    else
        message = "there is nothing to undo";
}

void Viewer::redo() {
    finish_edit();
    if (history_.can_redo())
        show_edits(history_.redo());
    else
        message = "there is nothing to redo";
}

void Viewer::orbit(double right, double up) {
    const scene::Scene& scene = session.loaded();
    state.camera.orbit(state.selected_light ? state.edits.center(scene, *state.selected_light)
                                            : middle_of(scene),
                       right, up);
}

std::string Viewer::save_screenshot(const std::filesystem::path& path) {
    image::check_writable_image(path);
    state.reduction = 1;
    session.finish(state);
    session.show(state);
    is_frame_finished = true;
    frame_seconds_ = 0;
    last_state_ = state;
    return write_screenshot(path, session, state, files);
}

void Viewer::load_lights(const std::filesystem::path& path) {
    session.apply(scene::read_rig(path));
    files.rigs.push_back(path);
    files.inputs.push_back(path);
    state.edits = {};
    history_ = {};
    state.selected_light.reset();
    last_state_ = state;
}

} // namespace nusselt::viewer
