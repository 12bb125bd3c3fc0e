#pragma once
/// Turns images on a device into the pixels of a window.

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "render_vulkan/accumulator.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace nusselt::render_vulkan {

/// How an image is shown.
enum class Shown : std::uint32_t {
    image, ///< with a tone curve and the transfer function of sRGB
    error, ///< its relative error from the reference: black up to 0.1 %, white from 100 % on
};

inline constexpr std::array kShown = {Shown::image, Shown::error};
std::string_view name_of(Shown shown);

/// How radiance beyond what a display shows is compressed, before the transfer function of sRGB.
enum class ToneCurve : std::uint32_t {
    none,     ///< clamped to 1
    reinhard, ///< divided by 1 + luminance (Reinhard et al. 2002, equation 3)
    filmic,   ///< the fit of the ACES curve by Narkowicz (2016), for each channel
};

inline constexpr std::array kToneCurves = {ToneCurve::none, ToneCurve::reinhard, ToneCurve::filmic};
std::string_view name_of(ToneCurve curve);

struct DisplaySettings {
    double exposure = 0; ///< [stops]
    double wipe = 1;     ///< the right image begins at this fraction of the width
    Shown shown = Shown::image;
    ToneCurve tone_curve = ToneCurve::none;
};

/// Root mean square differences from the reference, over pixels and channels; 0 without a reference.
struct DisplayErrors {
    double left = 0;
    double right = 0;
};

/// Shows two images of equal size side by side.
class DisplayPass {
public:
    /// \param device must outlive this object
    /// \throws gpu::Error if memory runs out or the driver cannot compile the shader
    DisplayPass(const gpu::Device& device, std::uint32_t width, std::uint32_t height);

    /// Fills pixels() and waits for them. All images have the size of the pass; those without a frame are black.
    /// \throws gpu::Error if the device is lost
    DisplayErrors show(const Accumulator& left, const Accumulator& right, const Accumulator& reference,
                       const DisplaySettings& settings);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    /// Row by row from the top, with red in the lowest byte and 255 in the highest.
    const std::vector<std::uint32_t>& pixels() const { return pixels_; }
    double seconds() const { return seconds_; } ///< the time that the last ones took on the device

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
