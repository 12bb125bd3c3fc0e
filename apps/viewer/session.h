#pragma once
/// Rendering for the viewer, without a window.

#include "view_state.h"

#include "gpu/device.h"
#include "image/image.h"
#include "render_vulkan/accumulator.h"
#include "render_vulkan/display_pass.h"
#include "scene/model/scene.h"
#include "scene/rig/rig.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace nusselt::viewer {

/// Times of the last frame [s].
struct SessionTimes {
    std::array<render_vulkan::FrameTimes, 2>
        frames; ///< by Side; 0 for the right one unless the screen is split
    render_vulkan::FrameTimes reference;
    double display = 0; ///< of the device, to make the picture
    double build = 0;   ///< to bring the scene to the device when its lights were changed last
};

struct PictureSize {
    std::uint32_t width = 0, height = 0; ///< [pixels]
};

/// Images of one scene: left, right and the reference, which all begin again whenever what they show changes. Each is there
/// in the resolution of the film and, once something has moved, in a lower one.
class Session {
public:
    /// \param device must outlive this.
    /// \param loaded as it was loaded, with the rigs that were given.
    /// \throws std::runtime_error if the scene does not fit the device
    Session(const gpu::Device& device, scene::Scene loaded, render_vulkan::ShadowRays shadow_rays);
    ~Session();

    /// Works on a frame of each image of the state: left, right and the reference. A frame that is not finished goes on
    /// with the next call, unless what it shows changes.
    /// \param seconds after about which the call returns
    /// \returns whether all frames are finished
    /// \throws std::invalid_argument for settings that do not fit together; the next state may mend that
    /// \throws std::runtime_error if a light cannot be changed in that way, or if the device fails
    bool render(const ViewState& state, double seconds = std::numeric_limits<double>::infinity());

    /// Finishes the frames that were begun, and renders one if an image of the state has none.
    /// \throws std::exception as render() does
    void finish(const ViewState& state);

    /// Makes the picture of what was rendered. Until the first frame of a camera is finished, that is the picture of lower
    /// resolution if there is one with the same camera and settings, else the rows that are finished.
    void show(const ViewState& state);

    /// The scene with the rigs, without the edits of a state.
    const scene::Scene& loaded() const { return loaded_; }
    /// Makes the changes of a rig for good. Edits of lights refer to the result.
    /// \throws std::runtime_error as scene::apply_rig() does; the scene is as before then
    void apply(const scene::Rig& rig);

    // The results of the last show(), valid after the first frame, and not between apply() and the next frame.
    const render_vulkan::DisplayPass& picture() const;
    PictureSize picture_size() const { return picture_size_; } ///< also valid after apply()
    const render_vulkan::DisplayErrors& errors() const { return errors_; }

    // Since something changed, in the resolution that was rendered last. Nothing before the first frame.
    image::Image image(Side side) const; ///< mean over frames
    std::uint32_t frames(Side side) const;
    std::uint32_t reference_frames() const;
    std::uint32_t seed(Side side) const; ///< of the last frame

    /// What scene::apply_rig() warned of: the rig that was applied last, then the edits of the last state.
    std::vector<std::string> warnings() const;

    const SessionTimes& times() const { return times_; }
    const gpu::Device& device() const { return device_; }
    render_vulkan::ShadowRays shadow_rays() const { return shadow_rays_; }

private:
    class Images;

    /// Brings the images up to date.
    void follow(const ViewState& state);

    const gpu::Device& device_;
    render_vulkan::ShadowRays shadow_rays_;
    scene::Scene loaded_;
    std::vector<std::string> rig_warnings_, edit_warnings_;
    std::unique_ptr<Images> images_; ///< none until the first frame
    PictureSize picture_size_;
    render_vulkan::DisplayErrors errors_;
    SessionTimes times_;
};

/// The settings of a reference for images with these.
render::RenderSettings reference_settings(const render::RenderSettings& settings);

} // namespace nusselt::viewer
