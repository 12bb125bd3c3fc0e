#pragma once
/// Renders direct light of a scene on a GPU.

#include "gpu/device.h"
#include "render/monitor.h"
#include "render/result.h"
#include "render/settings.h"
#include "render_vulkan/accumulator.h"
#include "render_vulkan/scene_textures.h"
#include "render_vulkan/shadows/shadow_scene.h"
#include "scene/model/scene.h"

#include <memory>
#include <optional>

namespace nusselt::render_vulkan {

/// A scene on a device, ready for rendering. One rendering at a time.
class VulkanRenderer {
public:
    /// \param device must outlive the renderer
    /// \param scene  its film gives the size of images
    /// \param textures see SceneTextures
    /// \throws std::runtime_error if the scene does not fit the device: see DeviceScene
    VulkanRenderer(const gpu::Device& device, const scene::Scene& scene, ShadowRays shadow_rays,
                   std::optional<TextureAccess> textures = {});
    ~VulkanRenderer();

    /// Renders one frame per camera ray: in a frame, all rays have the same position in their pixels.
    /// \throws std::invalid_argument see validate(), and for settings that only the CPU renderer supports
    /// \throws std::runtime_error if the device runs out of memory or is lost
    /// \returns the mean over all frames that were rendered
    render::RenderResult render(const render::RenderSettings& settings,
                                const render::RenderMonitor& monitor = {});

    const gpu::Device& device() const;
    ShadowRays shadow_rays() const;
    TextureAccess texture_access() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace nusselt::render_vulkan
