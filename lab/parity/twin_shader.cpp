#include "lab/parity/twin_shader.h"

#include "gpu/fused_fma.h"
#include "shaders/twins.h"

#include <stdexcept>
#include <string>

namespace nusselt::parity {

std::span<const std::uint32_t> twin_shader(std::string_view technique, int vertex_bound, Variant variant) {
    for (const TwinShader& shader : kTwinShaders)
        if (shader.technique == technique && shader.vertex_bound == vertex_bound && shader.variant == variant)
            return shader.spirv;
    throw std::logic_error("no such twin of " + std::string(technique));
}

std::vector<Variant> variants_for(const gpu::Device& device) {
    if (gpu::has_fused_fma(device)) return {Variant::split, Variant::fused};
    return {Variant::split};
}

} // namespace nusselt::parity
