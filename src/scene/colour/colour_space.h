#pragma once
/// Linear RGB colour spaces and their conversion to that of the scene model, linear sRGB.

#include "scene/model/vector_math.h"

#include <string_view>

namespace nusselt::scene {

/// The quantity that a spectrum or colour describes, which determines its reduction to linear sRGB.
enum class SpectrumUse {
    albedo,     ///< a factor of surfaces, also an optical constant: the constant 1 is white
    illuminant, ///< emission
};

/// CIE 1931 chromaticity.
struct Chromaticity {
    double x, y;
};

struct ColourSpace {
    std::string_view name;
    Chromaticity red, green, blue, white;
};

constexpr Chromaticity kWhiteD65 = {0.3127, 0.3290};
constexpr ColourSpace kSrgb = {"srgb", {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kWhiteD65};

/// Finds a colour space of pbrt: "srgb", "dci-p3", "rec2020" or "aces2065-1". Null for other names.
const ColourSpace* find_colour_space(std::string_view name);

/// Tristimulus values of luminance 1.
Double3 xyz_of(const Chromaticity& chromaticity);
/// Linear sRGB of tristimulus values; white is D65. Components are negative outside the gamut.
Double3 srgb_from_xyz(const Double3& xyz);
/// Linear sRGB of a colour of another space. An albedo of (1, 1, 1) stays white: chromatic adaptation by Bradford's
/// method. An illuminant of (1, 1, 1) keeps the chromaticity of the white point of `space`.
Double3 to_srgb(const Double3& rgb, const ColourSpace& space, SpectrumUse use);
/// Luminance (Y) of a colour in linear sRGB.
double luminance(const Double3& srgb);

} // namespace nusselt::scene
