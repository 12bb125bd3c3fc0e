#include "apps/common/render_setup.h"
#include "render_backend.h"

#include "gpu/device.h"
#include "render_vulkan/backend.h"
#include "render_vulkan/unsupported.h"

namespace nusselt::app {

std::optional<std::string> why_not_on_gpu(const RenderOptions& options,
                                          const render::RenderSettings& settings) {
    if (const auto reason = render_vulkan::why_unsupported(settings)) return reason;
    if (options.device) return std::nullopt;
    try {
        const gpu::DeviceDescription device = gpu::chosen_device();
        if (device.is_software) return "the only device, " + device.name + ", is a software device";
    } catch (const gpu::Error& error) {
        return error.what();
    }
    return std::nullopt;
}

std::unique_ptr<render::Backend> make_gpu_backend(const RenderOptions& options) {
    const gpu::DeviceOptions device{.choice = options.device};
    if (const auto reason = gpu::why_no_device(device)) throw gpu::NoDevice(*reason);
    std::optional<render_vulkan::ShadowRays> shadow_rays;
    if (options.shadow_rays) shadow_rays = from_name(render_vulkan::kShadowRays, *options.shadow_rays);
    return std::make_unique<render_vulkan::VulkanBackend>(device, shadow_rays);
}

} // namespace nusselt::app
