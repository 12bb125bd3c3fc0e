/// Spectra that have names in pbrt v4.

#include "scene/import/pbrt/syntax/named_spectra.h"

#include "scene/colour/spectrum.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace nusselt::scene {

namespace {

struct OpticalConstants {
    double wavelength; ///< [nm]
    double eta, k;
};

/// Rows of a constant table.
struct Substance {
    std::string_view name;
    const OpticalConstants* begin;
    const OpticalConstants* end;
};

// P. B. Johnson and R. W. Christy, Optical constants of the noble metals, Phys. Rev. B 6, 1972.
constexpr OpticalConstants kCopper[] = {
    {367.9, 1.36, 1.975}, {381.5, 1.33, 2.045}, {397.4, 1.32, 2.116}, {413.3, 1.28, 2.207},
    {430.5, 1.25, 2.305}, {450.9, 1.24, 2.397}, {471.4, 1.25, 2.483}, {495.9, 1.22, 2.564},
    {520.9, 1.18, 2.608}, {548.6, 1.02, 2.577}, {582.1, 0.70, 2.704}, {616.8, 0.30, 3.205},
    {659.5, 0.22, 3.747}, {704.5, 0.21, 4.205}, {756.0, 0.24, 4.665}, {821.1, 0.26, 5.180}};
constexpr OpticalConstants kSilver[] = {
    {367.9, 0.07, 1.657}, {381.5, 0.05, 1.864}, {397.4, 0.05, 2.070}, {413.3, 0.05, 2.275},
    {430.5, 0.04, 2.462}, {450.9, 0.04, 2.657}, {471.4, 0.05, 2.869}, {495.9, 0.05, 3.093},
    {520.9, 0.05, 3.324}, {548.6, 0.06, 3.586}, {582.1, 0.05, 3.858}, {616.8, 0.06, 4.152},
    {659.5, 0.05, 4.483}, {704.5, 0.04, 4.838}, {756.0, 0.03, 5.242}, {821.1, 0.04, 5.727}};
constexpr OpticalConstants kGold[] = {
    {367.9, 1.48, 1.895}, {381.5, 1.46, 1.933}, {397.4, 1.47, 1.952}, {413.3, 1.46, 1.958},
    {430.5, 1.45, 1.948}, {450.9, 1.38, 1.914}, {471.4, 1.31, 1.849}, {495.9, 1.04, 1.833},
    {520.9, 0.62, 2.081}, {548.6, 0.43, 2.455}, {582.1, 0.29, 2.863}, {616.8, 0.21, 3.272},
    {659.5, 0.14, 3.697}, {704.5, 0.13, 4.103}, {756.0, 0.14, 4.542}, {821.1, 0.16, 5.083}};
// A. D. Rakic, Algorithm for the determination of intrinsic optical constants of metal films: application to aluminum,
// Appl. Opt. 34, 1995.
constexpr OpticalConstants kAluminium[] = {
    {364.66, 0.39877, 4.3957}, {413.28, 0.52135, 5.0008}, {442.80, 0.60790, 5.3676},
    {476.87, 0.72780, 5.7781}, {516.60, 0.87340, 6.2418}, {563.57, 1.0728, 6.7839},
    {619.93, 1.3660, 7.4052},  {652.25, 1.5724, 7.7354},  {688.81, 1.8301, 8.0601},
    {729.32, 2.1606, 8.3565},  {774.91, 2.6154, 8.4914}};
// M. R. Querry, Optical constants, contractor report CRDC-CR-85034, 1985: 70 % copper, 30 % zinc.
constexpr OpticalConstants kBrass[] = {
    {380, 1.487, 1.818}, {400, 1.445, 1.805}, {420, 1.350, 1.786}, {440, 1.191, 1.797}, {460, 0.994, 1.883},
    {480, 0.816, 2.046}, {500, 0.686, 2.250}, {520, 0.602, 2.464}, {540, 0.549, 2.668}, {560, 0.505, 2.860},
    {580, 0.468, 3.059}, {600, 0.450, 3.253}, {620, 0.449, 3.434}, {640, 0.444, 3.609}, {660, 0.445, 3.778},
    {680, 0.444, 3.943}, {700, 0.446, 4.106}, {740, 0.455, 4.424}, {780, 0.464, 4.737}};
// The dispersion formula of R. E. Stephens and I. H. Malitson, Index of refraction of magnesium oxide, J. Res. Natl.
// Bur. Stand. 49, 1952.
constexpr OpticalConstants kMagnesiumOxide[] = {{380, 1.767, 0}, {420, 1.758, 0}, {460, 1.751, 0},
                                                {500, 1.746, 0}, {540, 1.741, 0}, {580, 1.738, 0},
                                                {620, 1.735, 0}, {660, 1.733, 0}, {700, 1.731, 0}};
// The dispersion formula of J. R. Devore, Refractive indices of rutile and sphalerite, J. Opt. Soc. Am. 41, 1951
// (ordinary ray).
constexpr OpticalConstants kTitaniumDioxide[] = {
    {430, 2.872, 0}, {440, 2.840, 0}, {450, 2.813, 0}, {460, 2.788, 0}, {480, 2.746, 0},
    {500, 2.711, 0}, {520, 2.683, 0}, {540, 2.659, 0}, {560, 2.638, 0}, {580, 2.620, 0},
    {620, 2.591, 0}, {660, 2.569, 0}, {700, 2.551, 0}, {740, 2.537, 0}};

template <std::size_t size>
constexpr Substance substance(std::string_view name, const OpticalConstants (&rows)[size]) {
    return {name, rows, rows + size};
}
constexpr Substance kMetals[] = {substance("metal-Cu", kCopper),
                                 substance("metal-Ag", kSilver),
                                 substance("metal-Au", kGold),
                                 substance("metal-Al", kAluminium),
                                 substance("metal-CuZn", kBrass),
                                 substance("metal-MgO", kMagnesiumOxide),
                                 substance("metal-TiO2", kTitaniumDioxide)};

// Refractive indices at 587.6 nm, from the catalogue of Schott.
constexpr std::pair<std::string_view, double> kGlasses[] = {
    {"glass-BK7", 1.5168}, {"glass-BAF10", 1.6700}, {"glass-FK51A", 1.4866}, {"glass-LASF9", 1.8503},
    {"glass-F5", 1.6727},  {"glass-SF5", 1.6727},   {"glass-F10", 1.7283},   {"glass-SF10", 1.7283},
    {"glass-F11", 1.7847}, {"glass-SF11", 1.7847}};

// CIE 15, for the observer of 1931.
constexpr std::pair<std::string_view, Chromaticity> kIlluminants[] = {
    {"stdillum-A", {0.44758, 0.40745}},   {"stdillum-D50", {0.34567, 0.35851}},
    {"stdillum-D65", kWhiteD65},          {"stdillum-F1", {0.31310, 0.33727}},
    {"stdillum-F2", {0.37208, 0.37529}},  {"stdillum-F3", {0.40910, 0.39430}},
    {"stdillum-F4", {0.44018, 0.40329}},  {"stdillum-F5", {0.31379, 0.34531}},
    {"stdillum-F6", {0.37790, 0.38835}},  {"stdillum-F7", {0.31292, 0.32933}},
    {"stdillum-F8", {0.34588, 0.35875}},  {"stdillum-F9", {0.37417, 0.37281}},
    {"stdillum-F10", {0.34609, 0.35986}}, {"stdillum-F11", {0.38052, 0.37713}},
    {"stdillum-F12", {0.43695, 0.40441}}, {"illum-acesD60", {0.32168, 0.33767}}};

Double3 reduced(const Substance& substance, double OpticalConstants::*constant) {
    std::vector<SpectrumSample> samples;
    std::transform(substance.begin, substance.end, std::back_inserter(samples),
                   [&](const OpticalConstants& row) {
                       return SpectrumSample{row.wavelength, row.*constant};
                   });
    return srgb_of(samples, SpectrumUse::albedo);
}

} // namespace

std::optional<Double3> named_spectrum(std::string_view name) {
    for (const auto& [illuminant, chromaticity] : kIlluminants)
        if (illuminant == name) return srgb_from_xyz(xyz_of(chromaticity));
    for (const auto& [glass, eta] : kGlasses)
        if (glass == name) return Double3{eta, eta, eta};
    for (const Substance& metal : kMetals) {
        if (!name.starts_with(metal.name)) continue;
        const std::string_view constant = name.substr(metal.name.size());
        if (constant == "-eta") return reduced(metal, &OpticalConstants::eta);
        if (constant == "-k") return reduced(metal, &OpticalConstants::k);
    }
    return std::nullopt;
}

} // namespace nusselt::scene
