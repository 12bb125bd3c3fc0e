#pragma once
/// From images on a device to what a window shows.

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "render_vulkan/accumulator.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace nusselt::render_vulkan {

/// What is shown of an image.
enum class Shown : std::uint32_t {
    image, ///< with the transfer function of sRGB
    error, ///< how far it is from the reference, relative to that: black up to 0.1 %, white from 100 % on
};

inline constexpr std::array kShown = {Shown::image, Shown::error};
std::string_view name_of(Shown shown);

struct DisplaySettings {
    double exposure = 0; ///< [stops]
    double wipe = 1;     ///< the right image is seen to the right of this share of the width
    Shown shown = Shown::image;
};

/// Root mean square differences from the reference, over pixels and channels; 0 without a reference.
struct DisplayErrors {
    double left = 0;
    double right = 0;
};

/// Puts two images of equal size side by side.
class DisplayPass {
public:
    /// \param device must outlive this.
    /// \throws gpu::Error if memory runs out or the driver cannot compile the shader
    DisplayPass(const gpu::Device& device, std::uint32_t width, std::uint32_t height);

    /// Fills pixels() and waits until that is done. All images have the size of the pass; without a frame they are black.
    /// \throws gpu::Error if the device is lost
    DisplayErrors show(const Accumulator& left, const Accumulator& right, const Accumulator& reference,
                       const DisplaySettings& settings);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    /// Row by row from the top; red in the lowest byte, the highest is 255.
    const std::vector<std::uint32_t>& pixels() const { return pixels_; }
    double seconds() const { return seconds_; } ///< that the device took for the last ones

private:
    const gpu::Device& device_;
    std::uint32_t width_, height_, groups_x_, groups_y_;
    gpu::Buffer shown_, squared_errors_;
    gpu::ComputePipeline pipeline_;
    std::vector<std::uint32_t> pixels_;
    std::vector<float> errors_;
    double seconds_ = 0;
};

} // namespace nusselt::render_vulkan
