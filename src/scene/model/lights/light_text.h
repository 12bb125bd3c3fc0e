#pragma once
/// Text of numbers in reports on lights.

#include "scene/model/vector_math.h"

#include <cstdio>
#include <string>

namespace nusselt::scene {

/// A number with six digits.
inline std::string report_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

inline std::string report_text(const Float3& v) {
    return report_text(v.x) + " " + report_text(v.y) + " " + report_text(v.z);
}

/// The power of lights whose emitting sides have this total area [m^2].
inline std::string power_text(double emitting_area, const Float3& radiance) {
    constexpr double kPi = 3.14159265358979323846;
    return "power " + report_text(to_float(emitting_area * kPi * to_double(radiance))) + " W";
}

} // namespace nusselt::scene
