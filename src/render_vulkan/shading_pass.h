#pragma once
/// Shades the triangles that a visibility pass has drawn.

#include "gpu/compute_pipeline.h"
#include "render/settings.h"
#include "render_vulkan/device_scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::render_vulkan {

/// The buffers of shaders/passes/shading.glsl for one image.
struct PixelBuffers {
    /// All sums and counters are zero.
    PixelBuffers(const gpu::Device& device, std::uint32_t width, std::uint32_t height);

    /// Sets all sums and counters to zero.
    void clear();

    std::uint32_t width, height;
    gpu::Buffer numbers; ///< of drawn triangles
    gpu::Buffer sums;    ///< one interface::PixelSum per pixel
    gpu::Buffer work;    ///< an interface::WorkRecord
};

/// The constants that choose a pipeline: all settings except heuristics, seeds and numbers of samples.
std::vector<std::uint32_t> shading_constants(const render::RenderSettings& settings, const SceneKinds& kinds);

/// Rows of pixels that work groups shade together.
inline constexpr std::uint32_t kRowsTogether = 8;

/// Adds frames to pixels.
class ShadingPass {
public:
    /// \param constants see shading_constants()
    ShadingPass(const DeviceScene& scene, const std::vector<std::uint32_t>& constants,
                const PixelBuffers& pixels);

    /// Adds the frame to some rows.
    /// \param frame its `first_row` is the first of them, a multiple of kRowsTogether
    /// \param rows their number, at least one; rows beyond the image are left out
    void record(const gpu::Device::Commands& commands, const interface::FrameRecord& frame,
                std::uint32_t rows) const;

private:
    std::uint32_t groups_x_;
    gpu::ComputePipeline pipeline_;
};

} // namespace nusselt::render_vulkan
