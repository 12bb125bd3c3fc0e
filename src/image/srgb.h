#pragma once
/// The transfer function of sRGB (IEC 61966-2-1) between linear light and code values, both in [0, 1].

#include <cmath>

namespace nusselt::image {

inline double srgb_from_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// The code of any linear value as a display shows it: clamped to [0, 1]; NaN becomes 0.
inline double display_code(double linear) {
    if (!(linear > 0)) return 0;
    return linear >= 1 ? 1 : srgb_from_linear(linear);
}

inline double linear_from_srgb(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

} // namespace nusselt::image
