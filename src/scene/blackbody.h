#pragma once
/// The colour of hot bodies.

#include "scene/vector_math.h"

namespace nusselt::scene {

/// Of linear RGB with the primaries of Rec. 709.
inline double srgb_luminance(const Double3& rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

/// Linear RGB with the primaries of Rec. 709 and the luminance 1 of a black body with this temperature in kelvin, 1000
/// to 40000. The component that would be negative for less than 1900 kelvin is 0.
Double3 blackbody_colour(double kelvin);

} // namespace nusselt::scene
