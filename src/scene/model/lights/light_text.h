#pragma once
/// Text of numbers in reports on lights, and the power that they state.

#include "scene/model/vector_math.h"

#include <cstdio>
#include <numbers>
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

/// The flux per radiance of surfaces that are equally bright from all sides. \param area that emits [m^2]
inline Double3 lambertian_flux(double area) {
    const double flux = area * std::numbers::pi;
    return {flux, flux, flux};
}

/// \param flux per emission
inline std::string power_text(const Double3& flux, const Float3& emission) {
    return "power " + report_text(to_float(per_channel_product(flux, to_double(emission)))) + " W";
}

} // namespace nusselt::scene
