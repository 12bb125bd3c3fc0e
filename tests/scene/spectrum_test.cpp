// Colours and spectra against published numbers and independent formulas.

#include "scene/build/textures/reflectance.h"
#include "scene/colour/spectrum.h"
#include "scene/import/pbrt/syntax/named_spectra.h"
#include "scene_fixture.h"

#include <cmath>

namespace nusselt::scene {
namespace {

void expect_near(const Double3& found, const Double3& expected, double tolerance) {
    EXPECT_NEAR(found.x, expected.x, tolerance);
    EXPECT_NEAR(found.y, expected.y, tolerance);
    EXPECT_NEAR(found.z, expected.z, tolerance);
}

/// The inverse of IEC 61966-2-1's matrix, as published.
Double3 xyz_from_srgb(const Double3& c) {
    return {0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z, 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
            0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z};
}

Chromaticity chromaticity(const Double3& srgb) {
    const Double3 xyz = xyz_from_srgb(srgb);
    const double sum = xyz.x + xyz.y + xyz.z;
    return {xyz.x / sum, xyz.y / sum};
}

/// Columns of a matrix from another colour space to linear sRGB.
void expect_matrix(std::string_view name, SpectrumUse use, const Double3& red, const Double3& green,
                   const Double3& blue, double tolerance) {
    SCOPED_TRACE(name);
    const ColourSpace* const space = find_colour_space(name);
    ASSERT_NE(space, nullptr);
    expect_near(to_srgb({1, 0, 0}, *space, use), red, tolerance);
    expect_near(to_srgb({0, 1, 0}, *space, use), green, tolerance);
    expect_near(to_srgb({0, 0, 1}, *space, use), blue, tolerance);
}

TEST(ColourSpaces, ConvertLikePublishedMatrices) {
    for (const SpectrumUse use : {SpectrumUse::albedo, SpectrumUse::illuminant}) {
        expect_matrix("srgb", use, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0);
        // ITU-R BT.2087, inverted.
        expect_matrix("rec2020", use, {1.6605, -0.1246, -0.0182}, {-0.5876, 1.1329, -0.1006},
                      {-0.0728, -0.0083, 1.1187}, 1e-4);
        expect_matrix("dci-p3", use, {1.2249, -0.0421, -0.0196}, {-0.2249, 1.0421, -0.0786}, {0, 0, 1.0983},
                      2e-4);
    }
    // The values include Bradford adaptation from the white of ACES, as in its reference implementation.
    expect_matrix("aces2065-1", SpectrumUse::albedo, {2.5217, -0.2765, -0.0154}, {-1.1341, 1.3727, -0.1530},
                  {-0.3876, -0.0962, 1.1683}, 2e-4);
    EXPECT_EQ(find_colour_space("adobe"), nullptr);
}

TEST(ColourSpaces, WhiteOfAcesLightIsYellower) {
    const Double3 white = to_srgb({1, 1, 1}, *find_colour_space("aces2065-1"), SpectrumUse::illuminant);
    EXPECT_NEAR(luminance(white), 1, 1e-12);
    EXPECT_NEAR(chromaticity(white).x, 0.32168, 1e-4);
    EXPECT_NEAR(chromaticity(white).y, 0.33767, 1e-4);
}

TEST(ColourSpaces, TristimulusValues) {
    expect_near(srgb_from_xyz(xyz_of(kWhiteD65)), {1, 1, 1}, 1e-12);
    expect_near(srgb_from_xyz({0.4124, 0.2126, 0.0193}), {1, 0, 0}, 2e-4);
    EXPECT_NEAR(luminance({0.2, 0.5, 0.7}), 0.2 * 0.2126 + 0.5 * 0.7152 + 0.7 * 0.0722, 1e-4);
}

TEST(Spectra, ConstantsAreWhiteAsAlbedoAndEqualEnergyAsLight) {
    for (const std::vector<SpectrumSample>& samples : {std::vector<SpectrumSample>{{500, 0.4}},
                                                       {{300, 0.4}, {900, 0.4}},
                                                       {{580, 0.4}, {581, 0.4}, {581, 0.4}}}) {
        expect_near(srgb_of(samples, SpectrumUse::albedo), {0.4, 0.4, 0.4}, 1e-12);
        expect_near(xyz_from_srgb(srgb_of(samples, SpectrumUse::illuminant)), {0.4, 0.4, 0.4}, 1e-4);
    }
}

TEST(Spectra, ColoursOfSingleWavelengths) {
    // Chromaticities of the spectral locus, CIE 15. The fit of the colour matching functions is good to about 0.01.
    struct Line {
        double wavelength;
        Chromaticity expected;
    };
    for (const Line& line : {Line{450, {0.1566, 0.0177}},
                             {520, {0.0743, 0.8338}},
                             {560, {0.3731, 0.6245}},
                             {600, {0.6270, 0.3725}},
                             {650, {0.7260, 0.2740}}}) {
        const double w = line.wavelength;
        const Chromaticity found =
            chromaticity(srgb_of({{w - 0.1, 0}, {w, 1}, {w + 0.1, 0}}, SpectrumUse::illuminant));
        EXPECT_NEAR(found.x, line.expected.x, 0.015) << w;
        EXPECT_NEAR(found.y, line.expected.y, 0.015) << w;
    }
}

TEST(Spectra, NarrowLinesKeepTheirEnergyWhereverTheyLie) {
    // Their area times the luminosity function over its integral, 106.857 nm.
    for (const double centre : {555.0, 555.25, 555.5, 555.93}) {
        const std::vector<SpectrumSample> line = {{centre - 0.02, 0}, {centre, 1000}, {centre + 0.02, 0}};
        EXPECT_NEAR(luminance(srgb_of(line, SpectrumUse::illuminant)), 20 / 106.857, 0.003) << centre;
    }
}

TEST(Spectra, StepsAndPiecesAddUp) {
    const Double3 below = srgb_of({{560, 1}, {560, 0}}, SpectrumUse::albedo);
    const Double3 above = srgb_of({{560, 0}, {560, 1}}, SpectrumUse::albedo);
    expect_near(below + above, {1, 1, 1}, 1e-12);
    EXPECT_GT(below.z, 0.95);
    EXPECT_GT(above.x, 1);
    const Double3 ramp = srgb_of({{400, 0}, {700, 1}}, SpectrumUse::albedo);
    const Double3 falling = srgb_of({{400, 1}, {700, 0}}, SpectrumUse::albedo);
    expect_near(ramp + falling, {1, 1, 1}, 1e-12);
}

TEST(Blackbodies, LieOnThePlanckianLocus) {
    // Published chromaticities; 2856 K is standard illuminant A. The tolerance is the error of the fit of the colour
    // matching functions.
    constexpr double kTolerance = 0.003;
    struct Body {
        double kelvin;
        Chromaticity expected;
    };
    for (const Body& body : {Body{2000, {0.5267, 0.4133}},
                             {2856, {0.4476, 0.4075}},
                             {4000, {0.3805, 0.3768}},
                             {6500, {0.3135, 0.3237}},
                             {10000, {0.2807, 0.2884}}}) {
        const Chromaticity found = chromaticity(srgb_of(blackbody(body.kelvin), SpectrumUse::illuminant));
        EXPECT_NEAR(found.x, body.expected.x, kTolerance) << body.kelvin;
        EXPECT_NEAR(found.y, body.expected.y, kTolerance) << body.kelvin;
    }
}

TEST(Blackbodies, PeakAtOne) {
    double largest = 0;
    for (const SpectrumSample& sample : blackbody(5000)) { // peak at 579.6 nm
        largest = std::max(largest, sample.value);
        EXPECT_LE(sample.value, 1 + 1e-12);
    }
    EXPECT_NEAR(largest, 1, 1e-5);
    for (const double kelvin : {100.0, 1e6})
        for (const SpectrumSample& sample : blackbody(kelvin)) {
            EXPECT_GT(sample.value, 0) << kelvin;
            EXPECT_LT(sample.value, 1) << kelvin;
        }
}

Double3 f0_of_metal(const std::string& name) {
    const Double3 eta = named_spectrum("metal-" + name + "-eta").value();
    const Double3 k = named_spectrum("metal-" + name + "-k").value();
    return {conductor_f0(eta.x, k.x), conductor_f0(eta.y, k.y), conductor_f0(eta.z, k.z)};
}

TEST(NamedSpectra, MetalsReflectAsPublished) {
    // T. Akenine-Moller and others, Real-Time Rendering, 4th edition, table 9.2. They integrated the reflectance, not
    // the optical constants, hence the tolerance.
    constexpr double kTolerance = 0.045;
    expect_near(f0_of_metal("Al"), {0.913, 0.922, 0.924}, kTolerance);
    expect_near(f0_of_metal("Au"), {1.022, 0.782, 0.344}, kTolerance);
    expect_near(f0_of_metal("Cu"), {0.955, 0.638, 0.538}, kTolerance);
    expect_near(f0_of_metal("CuZn"), {0.910, 0.778, 0.423}, kTolerance);
    // Their silver is tarnished. That of Johnson and Christy reflects 98 % at 471 nm and 549 nm, 99 % at 617 nm.
    expect_near(f0_of_metal("Ag"), {0.987, 0.983, 0.979}, 0.005);
}

TEST(NamedSpectra, OxidesFollowTheirDispersionFormulas) {
    std::vector<SpectrumSample> magnesium;
    std::vector<SpectrumSample> titanium;
    for (double w = 430; w <= 780; w += 5) {
        const double x = w * w * 1e-6; // micrometres squared
        magnesium.push_back({w, std::sqrt(1 + 1.111033 * x / (x - 0.0712465 * 0.0712465) +
                                          0.8460085 * x / (x - 0.1375204 * 0.1375204) +
                                          7.808527 * x / (x - 26.89302 * 26.89302))});
        titanium.push_back({w, std::sqrt(5.913 + 0.2441 / (x - 0.0803))});
    }
    expect_near(*named_spectrum("metal-MgO-eta"), srgb_of(magnesium, SpectrumUse::albedo), 2e-3);
    expect_near(*named_spectrum("metal-TiO2-eta"), srgb_of(titanium, SpectrumUse::albedo), 2e-3);
    expect_near(*named_spectrum("metal-MgO-k"), {0, 0, 0}, 0);
}

TEST(NamedSpectra, OthersAreUnknown) {
    for (const char* name :
         {"", "metal-Cu", "metal-Cu-", "metal-CuZ-eta", "metal-CuZn-eta2", "stdillum-D6", "glass"})
        EXPECT_FALSE(named_spectrum(name)) << name;
    expect_near(*named_spectrum("glass-BK7"), {1.5168, 1.5168, 1.5168}, 0);
}

} // namespace
} // namespace nusselt::scene
