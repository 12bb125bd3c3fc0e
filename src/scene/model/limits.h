#pragma once
/// How large scenes may be.

#include <cstddef>

namespace nusselt::scene {

inline constexpr int kMaxFilmSize = 65536; ///< pixels along an axis

// What indices of 32 bits tell apart beside a few special ones, those of triangles with a sign.
inline constexpr std::size_t kMaxVertices = 0xfffffffe;
inline constexpr std::size_t kMaxTriangles = 0x7fffffff;

} // namespace nusselt::scene
