#include "render_vulkan/shading_shaders.h"

#include "scene/input/file_bytes.h"

#include <cstring>
#include <stdexcept>

namespace nusselt::render_vulkan {

namespace {

std::vector<std::uint32_t> inflated_words(std::span<const unsigned char> gzip) {
    scene::Budget bytes(1 << 24, "a shader is larger than 16 MiB");
    const scene::FileBytes spirv =
        scene::inflated({reinterpret_cast<const char*>(gzip.data()), gzip.size()}, bytes);
    std::vector<std::uint32_t> words(spirv.view().size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), spirv.view().data(), words.size() * sizeof(std::uint32_t));
    return words;
}

} // namespace

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

std::vector<std::uint32_t> shading_shader(ShadingPassKind pass, const ShaderVariant& variant) {
    for (const ShadingShader& shader : shading_shaders())
        if (shader.pass == pass && shader.variant == variant) return inflated_words(shader.gzip);
    throw std::logic_error("this variant has no compiled shader");
}

} // namespace nusselt::render_vulkan
