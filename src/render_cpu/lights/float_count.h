#pragma once
/// The limit on the indices of kernels.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace nusselt::render_cpu {

/// \throws std::runtime_error if 32-bit indices cannot address that many numbers
inline void check_float_count(std::size_t count, const std::string& what) {
    constexpr std::size_t kMaxFloats = std::numeric_limits<std::int32_t>::max();
    if (count > kMaxFloats)
        throw std::runtime_error(what + ": " + std::to_string(count) + " numbers exceed the limit of " +
                                 std::to_string(kMaxFloats) + "; use a smaller scene");
}

} // namespace nusselt::render_cpu
