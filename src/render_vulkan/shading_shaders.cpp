#include "render_vulkan/shading_shaders.h"

#include <new>
#include <stdexcept>
#include <zlib.h>

namespace nusselt::render_vulkan {

namespace {

/// The words of a gzip file that the build made.
std::vector<std::uint32_t> inflated_words(std::span<const unsigned char> gzip) {
    // Its last four bytes are the size of what it holds, the least significant one first.
    const auto size = gzip.last<4>();
    const std::uint32_t bytes =
        size[0] | std::uint32_t{size[1]} << 8 | std::uint32_t{size[2]} << 16 | std::uint32_t{size[3]} << 24;
    std::vector<std::uint32_t> words(bytes / sizeof(std::uint32_t));

    z_stream stream = {};
    stream.next_in = const_cast<unsigned char*>(gzip.data()); // zlib does not write to its input
    stream.avail_in = static_cast<uInt>(gzip.size());
    stream.next_out = reinterpret_cast<unsigned char*>(words.data());
    stream.avail_out = bytes;
    constexpr int kLargestWindow = 15;
    constexpr int kGzipOnly = 16;
    if (inflateInit2(&stream, kLargestWindow + kGzipOnly) != Z_OK) throw std::bad_alloc();
    const int result = inflate(&stream, Z_FINISH);
    inflateEnd(&stream);
    if (result != Z_STREAM_END) throw std::logic_error("an embedded shader cannot be decompressed");
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
