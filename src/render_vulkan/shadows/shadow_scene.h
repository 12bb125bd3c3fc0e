#pragma once
/// The data in which shaders trace shadow rays.

#include "gpu/acceleration_structure.h"
#include "gpu/buffer.h"
#include "render_vulkan/shadows/shadow_rays.h"
#include "scene/model/scene.h"

#include <optional>
#include <vector>

namespace nusselt::render_vulkan {

/// Queries where the device supports them, unless it is a software device.
ShadowRays default_shadow_rays(const gpu::Device& device);

class ShadowScene {
public:
    /// \throws gpu::Error if the device has no memory for it, or does not support the ray queries asked for
    /// \throws std::runtime_error see make_triangle_bvh()
    ShadowScene(const gpu::Device& device, const scene::Scene& scene, ShadowRays way);

    ShadowRays way() const { return way_; }
    /// In the order of the bindings of shaders/passes/sample_lights_*.comp.
    std::vector<const gpu::Buffer*> buffers() const;
    /// For the binding after those; null without ray queries.
    const gpu::AccelerationStructure* structure() const { return structure_ ? &*structure_ : nullptr; }

private:
    ShadowRays way_;
    std::vector<gpu::Buffer> buffers_;
    std::optional<gpu::AccelerationStructure> structure_;
};

} // namespace nusselt::render_vulkan
