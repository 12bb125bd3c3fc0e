#pragma once
/// Spectra and their reduction to linear sRGB. docs/materials.md has the formulas.

#include "scene/colour/colour_space.h"

#include <vector>

namespace nusselt::scene {

struct SpectrumSample {
    double wavelength; ///< [nm]
    double value;
};

/// Linear between samples, constant beyond the first and the last one. Two samples at one wavelength are a step.
/// As an albedo the constant 1 becomes (1, 1, 1). As an illuminant the constant 1 has luminance 1 and the colour of
/// the equal-energy spectrum. Components are negative outside the gamut.
/// \param samples  at least one; sorted by wavelength
Double3 srgb_of(const std::vector<SpectrumSample>& samples, SpectrumUse use);

/// Planck's law, relative to its largest value over all wavelengths.
/// \param kelvin  positive
std::vector<SpectrumSample> blackbody(double kelvin);

} // namespace nusselt::scene
