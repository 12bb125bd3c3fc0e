#pragma once
/// The shaders of the techniques in GLSL.

#include "gpu/device.h"
#include "lab/parity/shader_runner.h"
#include "lab/parity/variant_names.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace nusselt::parity {

/// A row of the table of shaders that the build generates.
struct TwinShader {
    const char* technique; ///< class name; with `Rolled` before it where loops are not marked with [[unroll]]
    int vertex_bound;      ///< 2 for lines and cylinders
    std::span<const std::uint32_t> spirv;
};

/// \param technique as in TwinShader
/// \throws std::logic_error if there is no such shader
std::span<const std::uint32_t> find_twin(std::span<const TwinShader> shaders, std::string_view technique,
                                         int vertex_bound);

/// The shader of a technique of the library. \copydetails find_twin
VariantShader twin_shader(std::string_view technique, int vertex_bound, Variant variant);

/// The variants that give correct results on a device.
std::vector<Variant> variants_for(const gpu::Device& device);

} // namespace nusselt::parity
