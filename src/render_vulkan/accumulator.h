#pragma once
/// Images on a device that accumulate frames.

#include "gpu/raster_pass.h"
#include "image/image.h"
#include "render/settings.h"
#include "render_vulkan/device_scene.h"
#include "render_vulkan/shading_pass.h"

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::render_vulkan {

/// The time that the passes of one or more frames took on the device [s].
struct FrameTimes {
    double visibility = 0; ///< drawing what camera rays hit
    double shading = 0;    ///< including shadow rays
};

/// The work that all frames of an image took.
struct FrameWork {
    std::uint64_t shadow_rays = 0; ///< with ShadowRays::none, those left out
    /// Light samples that count as black because their direction, density or reflected radiance is NaN or infinite: 0
    /// unless there is NaN or overflow in the scene, or a bug.
    std::uint64_t rejected_samples = 0;
};

/// \param device its name, for messages
/// \throws gpu::Error if the image is wrong: a shader did not finish, or had no code for its settings
FrameWork checked_work(const interface::WorkRecord& work, const std::string& device);

/// An image of a scene, the mean over frames.
class Accumulator {
public:
    /// \param scene must outlive this object
    /// \throws std::invalid_argument see validate(), and for settings that are not supported
    /// \throws gpu::Error if memory runs out
    Accumulator(const DeviceScene& scene, const render::RenderSettings& settings);

    /// Begins again with black pixels and other settings. \throws std::invalid_argument as the constructor does
    void restart(const render::RenderSettings& settings);

    /// Compiles the shaders for the settings unless they are ready. Otherwise the next frame does.
    /// \throws gpu::Error if the driver cannot compile them
    void compile();

    /// Adds a frame and waits until it is finished.
    /// \param frame made for the settings, see FrameRecords
    /// \pre !is_adding()
    /// \throws gpu::Error if the device is lost, or as compile() does
    FrameTimes add(const interface::FrameRecord& frame);

    /// Likewise, but stops early once a request to cancel is made.
    /// \param cancel null for none
    /// \returns nothing if it stopped; the image is then as before
    std::optional<FrameTimes> add(const interface::FrameRecord& frame, const std::atomic<bool>* cancel);

    /// Begins a frame that add_rows() adds piece by piece.
    /// \pre !is_adding(): the sums would keep the rows of a frame that is not finished. Only restart() drops these.
    void begin(const interface::FrameRecord& frame);
    /// Whether rows of the frame are missing.
    bool is_adding() const { return next_row_ < height(); }
    /// Adds the next rows of the frame from the top, and waits until they are finished. After the last ones, the frame
    /// counts.
    /// \param most_rows is rounded up to a multiple of kRowsTogether; long ones are cut into several submissions
    /// \throws gpu::Error as add() does
    FrameTimes add_rows(std::uint32_t most_rows);

    std::uint32_t frames() const { return frames_; } ///< those that are finished
    /// How many rows from the top have a frame more.
    std::uint32_t rows_ahead() const { return is_adding() ? next_row_ : 0; }
    std::uint32_t width() const { return pixels_.width; }
    std::uint32_t height() const { return pixels_.height; }
    /// Black before the first frame.
    image::Image mean() const;
    /// \throws gpu::Error see checked_work()
    FrameWork work() const;
    /// One interface::PixelSum per pixel, the image times frames(), or one more in rows_ahead().
    const gpu::Buffer& sums() const { return pixels_.sums; }

private:
    /// Adds the rows of the frame from the next one on.
    /// \returns false if it was cancelled; some rows may then have parts of the frame
    bool add_until(std::uint32_t end, const std::atomic<bool>* cancel, FrameTimes& times);
    /// Leaves the frame out.
    std::nullopt_t give_up();
    void copy(const gpu::Buffer& from, const gpu::Buffer& to) const;
    // How much one submission shades.
    std::uint32_t samples_at_once(const interface::FrameRecord& frame) const; ///< of each light
    std::uint32_t lights_at_once(const interface::FrameRecord& frame) const;
    std::uint32_t rows_at_once(const interface::FrameRecord& frame) const;
    // The submissions for the rows of the frame from the next one to `end`, exclusive. There may be millions.
    std::uint64_t count_parts(std::uint32_t end) const;
    interface::FrameRecord make_part(std::uint64_t index) const;

    const DeviceScene& scene_;
    std::vector<std::uint32_t> constants_; ///< of the shading pass
    PixelBuffers pixels_;
    std::optional<gpu::Buffer> sums_before_; ///< without the frame that is being added, if that may stop
    gpu::RasterPass visibility_;
    std::optional<ShadingPass> shading_; ///< empty until it is compiled
    std::uint32_t frames_ = 0;
    interface::FrameRecord frame_ {}; ///< that is being added
    std::uint32_t next_row_;          ///< height() when the frame is finished
};

} // namespace nusselt::render_vulkan
