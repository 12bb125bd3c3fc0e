#include "render_vulkan/shading_shaders.h"

#include <stdexcept>

namespace nusselt::render_vulkan {

ShadingPassKind sampling_pass(ShadowRays way) {
    switch (way) {
    case ShadowRays::query:
        return ShadingPassKind::sample_lights_query;
    case ShadowRays::bvh:
        return ShadingPassKind::sample_lights_bvh;
    case ShadowRays::none:
        return ShadingPassKind::sample_lights_unshadowed;
    }
    throw std::logic_error("this way of tracing shadow rays has no shader");
}

std::span<const std::uint32_t> shading_shader(ShadingPassKind pass, const ShaderVariant& variant) {
    for (const ShadingShader& shader : shading_shaders())
        if (shader.pass == pass && shader.variant == variant) return shader.words;
    throw std::logic_error("this variant has no compiled shader");
}

} // namespace nusselt::render_vulkan
