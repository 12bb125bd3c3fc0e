#pragma once
/// An entry of the table of shaders that the build makes.

#include <cstdint>
#include <span>

namespace nusselt::parity {

enum class Variant {
    split,  ///< for any device
    fused,  ///< for devices whose fma rounds once
    rolled, ///< for any device, with loops that are left to the compiler
};

struct TwinShader {
    const char* technique; ///< class name
    int vertex_bound;      ///< 2 for lines and cylinders
    Variant variant;
    std::span<const std::uint32_t> spirv;
};

} // namespace nusselt::parity
