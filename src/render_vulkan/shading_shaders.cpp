#include "render_vulkan/shading_shaders.h"

#include "base/gzip.h"

#include <stdexcept>
#include <string_view>

namespace nusselt::render_vulkan {

namespace {

/// The words of a gzip file that the build made.
std::vector<std::uint32_t> inflated_words(std::span<const unsigned char> gzip) {
    // Its last four bytes are the size of what it holds, the least significant one first.
    const auto size = gzip.last<4>();
    const std::uint32_t bytes =
        size[0] | std::uint32_t{size[1]} << 8 | std::uint32_t{size[2]} << 16 | std::uint32_t{size[3]} << 24;
    std::vector<std::uint32_t> words(bytes / sizeof(std::uint32_t));

    std::string_view input(reinterpret_cast<const char*>(gzip.data()), gzip.size());
    char* output = reinterpret_cast<char*>(words.data());
    if (!base::InflateStream().step(input, output, bytes))
        throw std::logic_error("an embedded shader is larger than its gzip file says");
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
