#include "scene/blackbody.h"

#include <algorithm>
#include <cmath>

namespace nusselt::scene {

namespace {

/// A bell with different widths on both sides.
double lobe(double wavelength, double peak, double width_below, double width_above) {
    const double t = (wavelength - peak) / (wavelength < peak ? width_below : width_above);
    return std::exp(-0.5 * t * t);
}

/// The colour matching functions of CIE 1931. C. Wyman, P.-P. Sloan and P. Shirley 2013, Simple Analytic Approximations
/// to the CIE XYZ Color Matching Functions, JCGT 2(2), multi-lobe fit.
/// \param l  wavelength [nm]
Double3 colour_matching(double l) {
    return {1.056 * lobe(l, 599.8, 37.9, 31.0) + 0.362 * lobe(l, 442.0, 16.0, 26.7) -
                0.065 * lobe(l, 501.1, 20.4, 26.2),
            0.821 * lobe(l, 568.8, 46.9, 40.5) + 0.286 * lobe(l, 530.9, 16.3, 31.1),
            1.217 * lobe(l, 437.0, 11.8, 36.0) + 0.681 * lobe(l, 459.0, 26.0, 13.8)};
}

/// Planck's law up to a factor.
/// \param l  wavelength [nm]
double planck(double l, double kelvin) {
    constexpr double kSecondRadiationConstant = 1.438776877e7; // h c / k [nm K]
    return std::pow(l / 500, -5) / std::expm1(kSecondRadiationConstant / (l * kelvin));
}

} // namespace

Double3 blackbody_colour(double kelvin) {
    Double3 xyz;
    for (int l = 360; l <= 830; ++l) xyz = xyz + planck(l, kelvin) * colour_matching(l);
    const Double3 rgb = {dot({3.2404542, -1.5371385, -0.4985314}, xyz),
                         dot({-0.9692660, 1.8760108, 0.0415560}, xyz),
                         dot({0.0556434, -0.2040259, 1.0572252}, xyz)};
    const Double3 visible = {std::max(rgb.x, 0.0), std::max(rgb.y, 0.0), std::max(rgb.z, 0.0)};
    return (1 / srgb_luminance(visible)) * visible;
}

} // namespace nusselt::scene
