#pragma once
/// Images on a device that frames are added to.

#include "gpu/raster_pass.h"
#include "image/image.h"
#include "render/settings.h"
#include "render_vulkan/device_scene.h"
#include "render_vulkan/shading_pass.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::render_vulkan {

/// What the passes of one or more frames took [s].
struct FrameTimes {
    double visibility = 0; ///< drawing of what camera rays hit
    double shading = 0;    ///< with shadow rays
};

/// What was done for all frames of an image.
struct FrameWork {
    std::uint64_t shadow_rays = 0; ///< with ShadowRays::none those that were left out
    /// Light samples that count as black because their direction, density or reflected radiance is NaN or infinite: 0
    /// unless there is NaN or overflow in the scene, or a bug.
    std::uint64_t rejected_samples = 0;
};

/// \param device its name, for messages
/// \throws gpu::Error if shaders were not done or did not know their settings, so that the image is wrong
FrameWork checked_work(const interface::WorkRecord& work, const std::string& device);

/// An image of a scene: the mean over frames.
class Accumulator {
public:
    /// \param scene must outlive this.
    /// \throws std::invalid_argument see validate(), and for settings that are not supported
    /// \throws gpu::Error if memory runs out
    Accumulator(const DeviceScene& scene, const render::RenderSettings& settings);

    /// Black pixels, for other settings. \throws std::invalid_argument as the constructor does
    void restart(const render::RenderSettings& settings);

    /// Compiles the shaders for the settings unless that is done. The next frame does it otherwise.
    /// \throws gpu::Error if the driver cannot compile them
    void compile();

    /// Adds a frame and waits until it is done.
    /// \param frame of the settings, see FrameRecords
    /// \throws gpu::Error if the device is lost, or as compile() does
    FrameTimes add(const interface::FrameRecord& frame);

    std::uint32_t frames() const { return frames_; }
    std::uint32_t width() const { return pixels_.width; }
    std::uint32_t height() const { return pixels_.height; }
    /// Black without a frame.
    image::Image mean() const;
    /// \throws gpu::Error see checked_work()
    FrameWork work() const;
    /// One interface::PixelSum per pixel: divided by frames() they are the image.
    const gpu::Buffer& sums() const { return pixels_.sums; }

private:
    // How much is shaded in one submission.
    std::uint32_t samples_at_once(const interface::FrameRecord& frame) const; ///< of each light
    std::uint32_t lights_at_once(const interface::FrameRecord& frame) const;
    std::uint32_t rows_at_once(const interface::FrameRecord& frame) const;
    /// The frame in pieces of that size.
    std::vector<interface::FrameRecord> parts_of(const interface::FrameRecord& frame) const;

    const DeviceScene& scene_;
    std::vector<std::uint32_t> constants_; ///< of the shading pass
    PixelBuffers pixels_;
    gpu::RasterPass visibility_;
    std::optional<ShadingPass> shading_; ///< none until it is compiled
    std::uint32_t frames_ = 0;
};

/// Names the first setting that is not supported on GPUs; nothing if all are.
std::optional<std::string> why_unsupported(const render::RenderSettings& settings);

} // namespace nusselt::render_vulkan
