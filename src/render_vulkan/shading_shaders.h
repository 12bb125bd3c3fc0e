#pragma once
/// The variants of the shading pass.

#include "render_vulkan/scene_textures.h"
#include "render_vulkan/shadow_scene.h"

#include <cstdint>
#include <span>

namespace nusselt::render_vulkan {

/// What a shader is compiled for.
struct ShaderVariant {
    int polygon_slots; ///< 4 or 8, see SceneRecords
    bool fused_fma;    ///< see gpu::has_fused_fma()
    TextureAccess textures;
};

/// shaders/passes/sample_lights_*.comp.
std::span<const std::uint32_t> sampling_shader(const ShaderVariant& variant, ShadowRays way);

/// shaders/passes/integrate_lights.comp.
std::span<const std::uint32_t> integration_shader(const ShaderVariant& variant);

} // namespace nusselt::render_vulkan
