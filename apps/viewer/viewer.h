#pragma once
/// The viewer without its window: what is shown, and what can be done with it.

#include "frame_pace.h"
#include "pointer.h"
#include "session.h"
#include "view_files.h"
#include "view_state.h"

#include "scene/rig/rig_files.h"
#include "viewer/lights/edit_history.h"

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace nusselt::viewer {

struct Viewer {
    /// \param device must outlive this.
    /// \param loaded with the rigs of the files
    /// \throws std::runtime_error if the scene does not fit the device
    Viewer(const gpu::Device& device, const scene::Scene& loaded, render_vulkan::ShadowRays shadow_rays,
           const render::RenderSettings& settings, const SceneFiles& scene_files);

    /// Renders a frame, and one of the reference if that is wanted, and makes the picture. What the state cannot do, such
    /// as a light that cannot be changed in that way, becomes the message, and the state is what it was before. While
    /// something moves, the frame has a resolution that takes a tenth of a second, if there is one.
    /// \param seconds after about which the call returns if nothing moves; the next calls go on with the frame
    /// \throws gpu::Error if the device fails
    void next_frame(double seconds = std::numeric_limits<double>::infinity());

    // Changes of lights beside those of state.edits.
    /// Adds a light in the middle of the image and selects it. It is white and as bright as the first light of the scene.
    void add_light(LightShape shape);
    /// \throws std::invalid_argument if no light is selected
    void remove_selected_light();
    /// Ends an action, which undo() takes back as a whole.
    void finish_edit() { history_.note(state.edits); }
    /// Reads a profile, an image or a map for an edit. No file that is saved may replace it.
    /// \param read a function of scene::RigFiles, and what it throws
    template <class Content>
    std::shared_ptr<const Content>
    read_light_file(std::shared_ptr<const Content> (scene::RigFiles::*read)(const std::filesystem::path&),
                    const std::filesystem::path& path) {
        auto content = (light_files_.*read)(path);
        files.inputs.push_back(path);
        return content;
    }
    // Without an action to go back to or to repeat, a message says so.
    void undo();
    void redo();

    /// Moves the camera on a sphere about the selected light, or about the middle of the scene, see FlyCamera::orbit().
    void orbit(double right, double up);

    /// Finishes the frame in the resolution of the film and writes what is seen.
    /// \returns the command that renders the left image
    /// \throws std::exception as write_screenshot() and Session::render() do
    std::string save_screenshot(const std::filesystem::path& path);

    /// Applies a rig for good; what was edited before is gone, and cannot be undone.
    /// \throws std::runtime_error see scene::read_rig(), scene::apply_rig()
    void load_lights(const std::filesystem::path& path);

    Session session;
    ViewState state;
    SceneFiles files;
    std::string message; ///< for the person: what was done last, or why not
    Pointer pointer;
    bool shows_panel = true;
    std::optional<std::filesystem::path>
        window_screenshot; ///< the file that gets the next picture of the window
    bool is_closing = false;
    bool is_moving = false;        ///< set before a frame in which the view or a light moves
    bool is_frame_finished = true; ///< by the last call of next_frame()

private:
    void show_edits(const LightEdits& edits);

    EditHistory history_;
    scene::RigFiles light_files_;
    ViewState last_state_; ///< that could be rendered
    FramePace pace_;
    double frame_seconds_ = 0; ///< that the frame has taken so far
};

} // namespace nusselt::viewer
