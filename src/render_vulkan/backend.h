#pragma once
/// The backend that renders on a GPU.

#include "gpu/device.h"
#include "render/backend.h"
#include "render_vulkan/shadows/shadow_scene.h"

namespace nusselt::render_vulkan {

class VulkanBackend final : public render::Backend {
public:
    /// \param shadow_rays default: see default_shadow_rays()
    /// \throws gpu::Error if there is no such device
    explicit VulkanBackend(const gpu::DeviceOptions& options, std::optional<ShadowRays> shadow_rays = {});

    std::string_view name() const override { return "vulkan"; }
    std::optional<std::string> why_unsupported(const render::RenderSettings& settings) const override;
    std::optional<std::string> why_unsupported(const scene::Scene& scene,
                                               const render::RenderSettings& settings) const override;
    std::vector<std::string> warnings(const scene::Scene& scene,
                                      const render::RenderSettings& settings) const override;
    std::size_t layer_sum_bytes(const scene::Scene& scene,
                                const render::RenderSettings& settings) const override;
    std::unique_ptr<render::PreparedScene> prepare(const scene::Scene& scene) const override;
    image::Metadata metadata() const override;
    render::NamedTexts properties() const override;
    render::TimeReport times(const render::RenderStatistics& statistics) const override;

private:
    gpu::Device device_;
    ShadowRays shadow_rays_;
};

} // namespace nusselt::render_vulkan
