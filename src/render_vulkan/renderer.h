#pragma once
/// Renders direct light of a scene on a GPU.

#include "gpu/device.h"
#include "image/image.h"
#include "render/settings.h"
#include "render_vulkan/accumulator.h"
#include "render_vulkan/scene_textures.h"
#include "render_vulkan/shadow_scene.h"
#include "scene/model/scene.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace nusselt::render_vulkan {

/// How a rendering talks to its surroundings while it runs. All members may be left empty.
struct RenderMonitor {
    /// Called with the share of finished frames, in (0, 1].
    std::function<void(double fraction)> progress;
    /// Once this is true, no further frame is begun.
    const std::atomic<bool>* cancel = nullptr;
};

struct RenderStatistics {
    double build_seconds = 0;   ///< to bring the scene to the device
    double compile_seconds = 0; ///< of shaders, by the driver
    double render_seconds = 0;  ///< wall clock, from first to last frame
    // Sums over all frames [s], see FrameTimes.
    double visibility_seconds = 0;
    double shading_seconds = 0;
    std::uint64_t primary_rays = 0;
    FrameWork work;
};

struct RenderResult {
    image::Image image; ///< the mean over all frames that were rendered
    RenderStatistics statistics;
    double finished_fraction = 0; ///< of the frames; below 1 if it was cancelled
};

/// A scene on a device, ready for rendering. One rendering at a time.
class VulkanRenderer {
public:
    /// \param device must outlive the renderer.
    /// \param scene  its film gives the size of images.
    /// \param textures see SceneTextures
    /// \throws std::runtime_error if the scene does not fit the device: see DeviceScene
    VulkanRenderer(const gpu::Device& device, const scene::Scene& scene, ShadowRays shadow_rays,
                   std::optional<TextureAccess> textures = {});
    ~VulkanRenderer();

    /// Camera rays are frames: in each of them, all pixels have the same place in their pixel.
    /// \throws std::invalid_argument see validate(), and for settings that only the CPU has.
    /// \throws std::runtime_error if the device runs out of memory or is lost.
    RenderResult render(const render::RenderSettings& settings, const RenderMonitor& monitor = {});

    const gpu::Device& device() const;
    ShadowRays shadow_rays() const;
    TextureAccess texture_access() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace nusselt::render_vulkan
