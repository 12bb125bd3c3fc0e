#include "render_vulkan/renderer.h"

#include "base/stopwatch.h"
#include "render_vulkan/accumulator.h"
#include "render_vulkan/frame_records.h"

#include <optional>

namespace nusselt::render_vulkan {

struct VulkanRenderer::State {
    State(const gpu::Device& device, const scene::Scene& scene_to_render, ShadowRays shadow_rays,
          std::optional<TextureAccess> textures, const base::Stopwatch& stopwatch)
        : scene(device, scene_to_render, shadow_rays, textures), build_seconds(stopwatch.seconds()) {}

    DeviceScene scene;
    double build_seconds;
    std::optional<Accumulator> image; ///< the last one
};

VulkanRenderer::VulkanRenderer(const gpu::Device& device, const scene::Scene& scene, ShadowRays shadow_rays,
                               std::optional<TextureAccess> textures)
    : state_(std::make_unique<State>(device, scene, shadow_rays, textures, base::Stopwatch())) {}

VulkanRenderer::~VulkanRenderer() = default;

const gpu::Device& VulkanRenderer::device() const { return state_->scene.device(); }
ShadowRays VulkanRenderer::shadow_rays() const { return state_->scene.shadows().way(); }
TextureAccess VulkanRenderer::texture_access() const { return state_->scene.textures().access(); }

render::RenderResult VulkanRenderer::render(const render::RenderSettings& settings,
                                            const render::RenderMonitor& monitor) {
    render::RenderResult result;
    render::RenderStatistics& statistics = result.statistics;
    statistics.build_seconds = state_->build_seconds;
    const base::Stopwatch compiling;
    std::optional<Accumulator>& image = state_->image;
    if (image)
        image->restart(settings);
    else
        image.emplace(state_->scene, settings);
    image->compile();
    statistics.compile_seconds = compiling.seconds();

    const FrameRecords frames(state_->scene.film(), settings);
    const base::Stopwatch rendering;
    if (monitor.started) monitor.started();
    while (image->frames() < frames.count()) {
        const std::optional<FrameTimes> times = image->add(frames.make(image->frames()), monitor.cancel);
        if (!times) break;
        statistics.primary_seconds += times->visibility;
        statistics.shading_seconds += times->shading;
        if (monitor.progress) monitor.progress(static_cast<double>(image->frames()) / frames.count());
    }
    statistics.render_seconds = rendering.seconds();
    statistics.primary_rays = std::uint64_t{image->frames()} * image->width() * image->height();
    const FrameWork work = image->work();
    statistics.shadow_rays = work.shadow_rays;
    statistics.rejected_samples = work.rejected_samples;
    result.finished_fraction = static_cast<double>(image->frames()) / frames.count();
    result.image = image->mean();
    return result;
}

} // namespace nusselt::render_vulkan
