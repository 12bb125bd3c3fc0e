#pragma once
/// The shaders of the techniques in GLSL.

#include "lab/parity/shader_platform.h"

#include <span>
#include <string_view>

namespace nusselt::parity {

/// A row of the table of shaders that the build generates.
struct TwinShader {
    const char* technique; ///< class name; with `Rolled` before it where loops are not marked with [[unroll]]
    int vertex_bound;      ///< 2 for lines and cylinders
    Shader shader;
};

/// \param technique as in TwinShader
/// \throws std::logic_error if there is no such shader
Shader find_twin(std::span<const TwinShader> shaders, std::string_view technique, int vertex_bound);

/// The shader of a technique of the library. \copydetails find_twin
VariantShader twin_shader(std::string_view technique, int vertex_bound, Variant variant);

} // namespace nusselt::parity
