#include "lab/parity/twin_shader.h"

#include "shaders/twins.h"

#include <stdexcept>
#include <string>

namespace nusselt::parity {

Shader find_twin(std::span<const TwinShader> shaders, std::string_view technique, int vertex_bound) {
    for (const TwinShader& shader : shaders)
        if (shader.technique == technique && shader.vertex_bound == vertex_bound) return shader.shader;
    throw std::logic_error("no such twin of " + std::string(technique));
}

VariantShader twin_shader(std::string_view technique, int vertex_bound, Variant variant) {
    std::string name(technique);
    if (variant == Variant::rolled) name.insert(0, "Rolled");
    return {find_twin(kTwinShaders, name, vertex_bound), variant};
}

} // namespace nusselt::parity
