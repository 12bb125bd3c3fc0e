#pragma once
/// The variants of a shader, by how it takes exact products.

#include <cstddef>

namespace nusselt::parity {

enum class Variant {
    split,  ///< for any device
    fused,  ///< for devices whose fma rounds once
    rolled, ///< for any device, with loops that are not marked with [[unroll]]
    webgl,  ///< in GLSL ES, for browsers
};
inline constexpr const char* kVariantNames[] = {"any device", "fused fma", "any device, rolled loops",
                                                "WebGL 2"};
inline const char* name_of(Variant variant) { return kVariantNames[static_cast<std::size_t>(variant)]; }

} // namespace nusselt::parity
