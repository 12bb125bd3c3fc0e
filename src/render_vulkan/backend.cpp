#include "render_vulkan/backend.h"

#include "render_vulkan/accumulator.h"
#include "render_vulkan/renderer.h"
#include "render_vulkan/unsupported.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

namespace nusselt::render_vulkan {

namespace {

/// Copies the pixels of a tile to a frame.
/// \param from an image of the same size as that of the frame
void copy_tile(const image::Image& from, const render::Tile& tile, render::Frame& frame) {
    const auto width = static_cast<std::size_t>(from.width);
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
        const std::size_t first = static_cast<std::size_t>(y - frame.bounds.y_begin) * width +
                                  static_cast<std::size_t>(tile.x_begin - frame.bounds.x_begin);
        std::copy_n(from.pixels.data() + 3 * first, 3 * static_cast<std::size_t>(tile.x_end - tile.x_begin),
                    frame.image.pixels.data() + 3 * first);
    }
}

class VulkanScene final : public render::PreparedScene {
public:
    VulkanScene(const gpu::Device& device, const scene::Scene& scene, ShadowRays shadow_rays)
        : renderer_(device, scene, shadow_rays) {}

    render::RenderStatistics render_into(render::Frame& frame, const render::RenderSettings& settings,
                                         const render::RenderMonitor& monitor) override {
        const render::RenderResult result = renderer_.render(settings, monitor);
        const auto rays = static_cast<float>(std::round(result.finished_fraction * frame.camera_rays));
        if (rays == 0) return result.statistics;
        for (std::size_t i = 0; i < frame.tiles.size(); ++i) {
            if (frame.is_finished[i] != 0) continue;
            copy_tile(result.image, frame.tiles[i], frame);
            for_each_row(frame, frame.tiles[i], frame.rays, 1,
                         [&](float* row, std::size_t size) { std::fill_n(row, size, rays); });
            if (result.finished_fraction < 1) continue;
            frame.is_finished[i] = 1;
            if (monitor.tile_finished) monitor.tile_finished(i);
        }
        return result.statistics;
    }

private:
    VulkanRenderer renderer_;
};

} // namespace

VulkanBackend::VulkanBackend(const gpu::DeviceOptions& options, std::optional<ShadowRays> shadow_rays)
    : device_(options), shadow_rays_(shadow_rays.value_or(default_shadow_rays(device_))) {}

std::optional<std::string> VulkanBackend::why_unsupported(const render::RenderSettings& settings) const {
    return render_vulkan::why_unsupported(settings);
}

std::optional<std::string> VulkanBackend::why_unsupported(const scene::Scene& scene,
                                                          const render::RenderSettings& settings) const {
    return render_vulkan::why_unsupported(scene, settings);
}

std::vector<std::string> VulkanBackend::warnings(const scene::Scene& scene,
                                                 const render::RenderSettings& settings) const {
    return render_vulkan::sampling_warnings(scene, settings);
}

std::size_t VulkanBackend::layer_sum_bytes(const scene::Scene&, const render::RenderSettings&) const {
    return 0;
}

std::unique_ptr<render::PreparedScene> VulkanBackend::prepare(const scene::Scene& scene) const {
    return std::make_unique<VulkanScene>(device_, scene, shadow_rays_);
}

image::Metadata VulkanBackend::metadata() const { return {{"device", device_.description().name}}; }

render::NamedTexts VulkanBackend::properties() const {
    return {{"device", device_.description().name},
            {"driver", device_.description().driver},
            {"shadow_ray_tracing", std::string(name_of(shadow_rays_))}};
}

render::TimeReport VulkanBackend::times(const render::RenderStatistics& statistics) const {
    return {{{"upload", statistics.build_seconds}, {"compile", statistics.compile_seconds}},
            "device_seconds",
            {{"visibility", statistics.primary_seconds}, {"shading", statistics.shading_seconds}}};
}

} // namespace nusselt::render_vulkan
