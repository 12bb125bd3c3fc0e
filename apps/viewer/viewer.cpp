#include "viewer.h"

#include "scene/rig/rig_json.h"

#include <exception>

namespace nusselt::viewer {

namespace {

scene::Scene without_crop(scene::Scene scene) {
    scene.film.crop.reset();
    return scene;
}

} // namespace

Viewer::Viewer(const gpu::Device& device, const scene::Scene& loaded, render_vulkan::ShadowRays shadow_rays,
               const render::RenderSettings& settings, const SceneFiles& scene_files)
    : session(device, without_crop(loaded), shadow_rays),
      state{.camera = FlyCamera(loaded.camera, loaded.film.width, loaded.film.height),
            .settings = {settings, settings}},
      files(scene_files),
      last_state_(state) {}

void Viewer::next_frame() {
    try {
        session.render(state);
        if (state.renders_reference) session.render_reference(state);
        session.show(state);
    } catch (const gpu::Error&) {
        throw;
    } catch (const std::exception& error) {
        message = error.what();
        state = last_state_;
        session.render(state);
        session.show(state);
        return;
    }
    if (state.edits != last_state_.edits) message.clear();
    last_state_ = state;
}

void Viewer::load_lights(const std::filesystem::path& path) {
    session.apply(scene::read_rig(path));
    files.rigs.push_back(path);
    state.edits = {};
    state.selected_light.reset();
    last_state_ = state;
}

} // namespace nusselt::viewer
