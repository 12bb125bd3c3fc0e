#pragma once
/// Vectors in double precision, for geometry that is prepared once per scene.

#include "scene/model/limits.h"
#include "scene/model/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nusselt::scene {

inline Double3 to_double(const Float3& v) { return {v.x, v.y, v.z}; }
inline Float3 to_float(const Double3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Float3 float3_of(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
inline Double3 operator+(const Double3& a, const Double3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Double3 operator-(const Double3& a, const Double3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Double3 operator*(double s, const Double3& v) { return {s * v.x, s * v.y, s * v.z}; }
inline Double3 per_channel_product(const Double3& a, const Double3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline double dot(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Double3 cross(const Double3& a, const Double3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Double3& v) { return std::sqrt(dot(v, v)); }
/// v / |v|; the zero vector stays zero.
inline Double3 normalized(const Double3& v) {
    const double l = length(v);
    return l > 0 ? (1 / l) * v : v;
}

inline Float3 per_channel_product(const Float3& a, const Float3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
/// 0 where the denominator is 0.
inline Float3 per_channel_ratio(const Float3& a, const Float3& b) {
    const auto ratio = [](float x, float y) { return y > 0 ? x / y : 0; };
    return {ratio(a.x, b.x), ratio(a.y, b.y), ratio(a.z, b.z)};
}

/// Each channel that reaches kDarkest; 0 for the others.
inline Float3 lit_channels(const Float3& c) {
    const auto lit = [](float x) { return x < static_cast<float>(kDarkest) ? 0 : x; };
    return {lit(c.x), lit(c.y), lit(c.z)};
}
/// The larger of both, for each channel.
inline Float3 per_channel_maximum(const Float3& a, const Float3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

inline bool is_black(const Float3& c) { return c.x == 0 && c.y == 0 && c.z == 0; }

/// The largest coordinate that ray tracing supports [m]. Embree asserts above 1.8e18.
inline constexpr double kMaxCoordinate = 1e15;

/// Whether all components are finite and at most kMaxCoordinate.
inline bool is_valid_coordinate(const Float3& p) {
    constexpr auto kLimit = static_cast<float>(kMaxCoordinate);
    return std::fabs(p.x) <= kLimit && std::fabs(p.y) <= kLimit && std::fabs(p.z) <= kLimit;
}

} // namespace nusselt::scene
