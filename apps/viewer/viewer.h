#pragma once
/// The viewer without its window: what is shown, and what can be done with it.

#include "session.h"
#include "view_files.h"
#include "view_state.h"

#include <string>

namespace nusselt::viewer {

struct Viewer {
    /// \param device must outlive this.
    /// \param loaded with the rigs of the files
    /// \throws std::runtime_error if the scene does not fit the device
    Viewer(const gpu::Device& device, const scene::Scene& loaded, render_vulkan::ShadowRays shadow_rays,
           const render::RenderSettings& settings, const SceneFiles& scene_files);

    /// Renders a frame, and one of the reference if that is wanted, and makes the picture. What the state cannot do, such
    /// as a light that cannot be changed in that way, becomes the message, and the state is what it was before.
    /// \throws gpu::Error if the device fails
    void next_frame();

    /// Applies a rig for good; what was edited before is gone.
    /// \throws std::runtime_error see scene::read_rig(), scene::apply_rig()
    void load_lights(const std::filesystem::path& path);

    Session session;
    ViewState state;
    SceneFiles files;
    std::string message; ///< for the person: what was done last, or why not
    bool is_closing = false;

private:
    ViewState last_state_; ///< that could be rendered
};

} // namespace nusselt::viewer
