#pragma once
/// Vectors of scenes as those of the library, and back.

#include "scene/model/float3.h"

#include <nusselt/core/vec.h>

namespace nusselt::scene {

inline Vec3<float> to_vec(const Float3& v) { return {v.x, v.y, v.z}; }
inline Float3 to_float3(const Vec3<float>& v) { return {v.x, v.y, v.z}; }

} // namespace nusselt::scene
