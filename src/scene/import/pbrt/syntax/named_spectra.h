#pragma once
/// The spectra that scene files name.

#include "scene/model/vector_math.h"

#include <optional>
#include <string_view>

namespace nusselt::scene {

/// Linear sRGB of a spectrum that has a name in pbrt v4: optical constants like "metal-Cu-eta" and "glass-BK7" as
/// albedos, illuminants like "stdillum-D50" with luminance 1. Nothing for other names.
std::optional<Double3> named_spectrum(std::string_view name);

} // namespace nusselt::scene
