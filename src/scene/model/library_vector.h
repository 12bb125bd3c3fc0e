#pragma once
/// Vectors of scenes as those of the library, and back.

#include "scene/model/float3.h"

#include <nusselt/core/vec.h>

#include <vector>

namespace nusselt::scene {

inline Vec3<float> to_vec(const Float3& v) { return {v.x, v.y, v.z}; }
inline Float3 to_float3(const Vec3<float>& v) { return {v.x, v.y, v.z}; }

/// Colours as vectors of the library, each times a factor per channel.
inline std::vector<Vec3<float>> scaled(const std::vector<Float3>& colours, const Float3& factor) {
    std::vector<Vec3<float>> result;
    result.reserve(colours.size());
    for (const Float3& colour : colours) result.push_back(to_vec(factor) * to_vec(colour));
    return result;
}

} // namespace nusselt::scene
