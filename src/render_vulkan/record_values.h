#pragma once
/// Numbers in the form of records of shaders/interface.

#include "scene/model/float3.h"

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace nusselt::render_vulkan {

/// \throws std::runtime_error if 32 bits cannot number that many things
inline std::uint32_t checked_count(std::uint64_t count, const std::string& what) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (count > kMost)
        throw std::runtime_error(std::to_string(count) + " " + what + " exceed the limit of " +
                                 std::to_string(kMost) + " on GPUs; use --backend cpu");
    return static_cast<std::uint32_t>(count);
}

inline void copy(const scene::Float3& from, float (&to)[3]) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

} // namespace nusselt::render_vulkan
