#pragma once
/// The same image by both renderers.

#include "gpu/device.h"
#include "image/image.h"
#include "render/settings.h"
#include "render_vulkan/shadows/shadow_rays.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace nusselt::lab {

/// With the same random numbers, pixels differ for three reasons: formulas round differently, by parts in a million; what is
/// drawn has its edges where the device's fixed point arithmetic puts them, so that the centre of a pixel may be on the
/// other side; and a shadow ray that passes an edge within rounding is blocked or not. The last two concern single pixels
/// along edges.
inline constexpr double kRelativeTolerance = 1e-3;

/// Values below this share of an image's mean are compared relative to it: where light grazes a surface, they are rounding.
inline constexpr double kDarkest = 0.01;

/// The share of pixels along edges that may differ. Measured: up to 1.5 % on shipped scenes of 64 x 48 pixels.
inline constexpr double kLargestDifferingShare = 0.03;

/// image::differing_share() with kRelativeTolerance and kDarkest.
double differing_share(const image::Image& a, const image::Image& b);

/// How an image of the GPU differs from that of the CPU.
struct ImageAgreement {
    render_vulkan::ShadowRays shadow_rays;
    render::RenderSettings settings;
    double share;                   ///< of pixels that differ
    std::uint64_t rejected_samples; ///< that were not finite, on the GPU

    bool passes() const { return share < kLargestDifferingShare && rejected_samples == 0; }
};

/// The settings to compare: each technique, and two techniques together, with pixel centres, on which renderers agree.
std::vector<render::RenderSettings> compared_settings();

/// Renders a scene with each of the settings, on the CPU once and on the GPU with each way to trace shadow rays.
/// \throws std::runtime_error if the scene does not fit the device
std::vector<ImageAgreement> compare_with_cpu(const gpu::Device& device, const scene::Scene& scene,
                                             std::span<const render_vulkan::ShadowRays> ways,
                                             std::span<const render::RenderSettings> settings);

} // namespace nusselt::lab
