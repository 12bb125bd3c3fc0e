#pragma once
/// The same image by both renderers.

#include "render_cpu/renderer.h"
#include "render_vulkan/renderer.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render_vulkan_test {

/// With the same random numbers, pixels differ for three reasons: formulas round differently, by parts in a million; what is
/// drawn has its edges where the device's fixed point arithmetic puts them, so that the centre of a pixel may be on the
/// other side; and a shadow ray that passes an edge within rounding is blocked or not. The last two concern single pixels
/// along edges.
inline constexpr double kRelativeTolerance = 1e-3;

/// Share of pixels with a channel that differs by more than the tolerance: of itself, or of a hundredth of the mean where
/// it is darker than that. NaN does.
inline double differing_share(const image::Image& a, const image::Image& b) {
    double mean = 0;
    for (const float value : b.pixels) mean += value / static_cast<double>(b.pixels.size());
    const auto differs = [&](std::size_t i) {
        const double difference = std::fabs(static_cast<double>(a.pixels[i]) - b.pixels[i]);
        return !(difference <= kRelativeTolerance * std::max<double>(std::fabs(b.pixels[i]), 0.01 * mean));
    };
    std::size_t count = 0;
    for (std::size_t i = 0; i < b.pixels.size(); i += 3)
        count += differs(i) || differs(i + 1) || differs(i + 2);
    return static_cast<double>(count) / (static_cast<double>(b.pixels.size()) / 3);
}

inline image::Image render_on_cpu(const scene::Scene& scene, const render::RenderSettings& settings) {
    return render_cpu::Renderer(scene, 2).render(settings, base::choose_isa()).image;
}

} // namespace nusselt::render_vulkan_test
