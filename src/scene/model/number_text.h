#pragma once
/// Numbers in files that are read again.

#include "scene/model/float3.h"

#include <charconv>
#include <string>

namespace nusselt::scene {

/// The shortest text that gives the same float.
inline std::string number_text(float value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

inline std::string triple_text(const Float3& v) {
    return "[" + number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z) + "]";
}

} // namespace nusselt::scene
