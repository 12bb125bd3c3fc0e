#pragma once
/// An entry of the table of shaders that the build generates.

#include <cstdint>
#include <span>

namespace nusselt::parity {

enum class Variant {
    split,  ///< for any device
    fused,  ///< for devices whose fma rounds once
    rolled, ///< for any device, with loops that are not marked with [[unroll]]
};

struct TwinShader {
    const char* technique; ///< class name
    int vertex_bound;      ///< 2 for lines and cylinders
    Variant variant;
    std::span<const std::uint32_t> spirv;
};

} // namespace nusselt::parity
