#include "python/bindings/render_backend.h"

#include "gpu/device.h"
#include "render_vulkan/backend.h"
#include "render_vulkan/shadows/shadow_rays.h"
#include "render_vulkan/unsupported.h"

namespace nusselt::python {

bool is_for_gpu(const BackendChoice& choice, const render::RenderSettings& settings) {
    if (render_vulkan::why_unsupported(settings)) return false;
    if (choice.device) return true;
    try {
        return !gpu::chosen_device().is_software;
    } catch (const gpu::Error&) {
        return false;
    }
}

std::unique_ptr<render::Backend> make_gpu_backend(const BackendChoice& choice) {
    const gpu::DeviceOptions device{.choice = choice.device};
    if (const auto reason = gpu::why_no_device(device)) throw gpu::NoDevice(*reason);
    std::optional<render_vulkan::ShadowRays> shadow_rays;
    if (choice.shadow_rays) shadow_rays = render::from_name(render_vulkan::kShadowRays, *choice.shadow_rays);
    return std::make_unique<render_vulkan::VulkanBackend>(device, shadow_rays);
}

} // namespace nusselt::python
