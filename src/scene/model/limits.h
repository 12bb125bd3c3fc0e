#pragma once
/// How large scenes and their values may be.

#include <cstddef>

namespace nusselt::scene {

inline constexpr int kMaxFilmSize = 65536; ///< pixels along an axis

/// Of the emission of a light, in the unit of its quantity. Sums over many samples of far brighter lights would overflow.
inline constexpr double kMaxRadiance = 1e30;

/// Of the means of images, maps and profiles, and of what lights with an image emit, per channel: what is darker counts as
/// black. Renderers divide by these numbers, whose reciprocals and products would leave the range of single precision.
inline constexpr double kDarkest = 1e-30;

/// Of spots [degrees]. Directions in single precision are 3e-6 degrees apart: hardly one of them lies within narrower cones.
inline constexpr double kNarrowestCone = 1e-6;

/// Of Phong lobes. Single precision does not resolve directions in much narrower ones.
inline constexpr double kLargestPhongExponent = 1e6;

// Indices have 32 bits with a few special values; those of triangles have a sign.
inline constexpr std::size_t kMaxVertices = 0xfffffffe;
inline constexpr std::size_t kMaxTriangles = 0x7fffffff;

} // namespace nusselt::scene
