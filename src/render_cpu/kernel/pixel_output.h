#pragma once
/// Stores packets of pixels in images.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/random.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Number of a packet's pixel in the image, row by row. The pixel must be inside the tile.
inline std::uint64_t pixel_index(const render_cpu::RenderJob& job, const PixelBlock& block,
                                 int lane) noexcept {
    const std::uint64_t row = block.y[lane] - static_cast<std::uint32_t>(job.y_begin);
    const std::uint64_t column = block.x[lane] - static_cast<std::uint32_t>(job.x_begin);
    return row * static_cast<std::uint64_t>(job.width) + column;
}

/// \param image three floats per pixel
inline void store_rgb(const render_cpu::RenderJob& job, const PixelBlock& block, const Vector& rgb,
                      float* image) noexcept {
    const Lanes lanes = store(rgb);
    const std::uint32_t inside = block.inside.bits();
    for (int i = 0; i < kLanes; ++i) {
        if ((inside >> i & 1u) == 0) continue;
        float* pixel = image + 3 * pixel_index(job, block, i);
        pixel[0] = lanes.x[i];
        pixel[1] = lanes.y[i];
        pixel[2] = lanes.z[i];
    }
}

/// \param image one float per pixel
inline void store_grey(const render_cpu::RenderJob& job, const PixelBlock& block, const Real& value,
                       float* image) noexcept {
    alignas(4 * kLanes) float lanes[kLanes];
    value.store(lanes);
    const std::uint32_t inside = block.inside.bits();
    for (int i = 0; i < kLanes; ++i)
        if ((inside >> i & 1u) != 0) image[pixel_index(job, block, i)] = lanes[i];
}

} // namespace kernel
NUSSELT_NAMESPACE_END
