#include "scene/sky/preetham_sky.h"

#include "scene/colour/spectrum.h"
#include "scene/model/profiles/profile_radiance.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace nusselt::scene {

namespace {

constexpr double kPi = std::numbers::pi;

/// Slope over turbidity and value at 0 (appendix A.2): A to E of luminance, x and y.
constexpr double kPerez[3][5][2] = {
    {{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}},
    {{-0.0193, -0.2592}, {-0.0665, 0.0008}, {-0.0004, 0.2125}, {-0.0641, -0.8989}, {-0.0033, 0.0452}},
    {{-0.0167, -0.2608}, {-0.0950, 0.0092}, {-0.0079, 0.2102}, {-0.0441, -1.6537}, {-0.0109, 0.0529}},
};

/// Chromaticity x and y of the zenith: rows for powers 2 to 0 of turbidity, columns for powers 3 to 0 of the angle
/// between the sun and the zenith [rad].
constexpr double kZenith[2][3][4] = {
    {{0.00166, -0.00375, 0.00209, 0},
     {-0.02903, 0.06377, -0.03202, 0.00394},
     {0.11693, -0.21196, 0.06052, 0.25886}},
    {{0.00275, -0.00610, 0.00317, 0},
     {-0.04214, 0.08970, -0.04153, 0.00516},
     {0.15346, -0.26756, 0.06670, 0.26688}},
};

/// Perez' function of the height of a direction and its angle from the sun.
double perez(const double (&c)[5], double cosine, double angle, double cosine_of_angle) {
    // Towards the horizon the first exponential vanishes: its exponent is negative.
    const double height = std::max(cosine, 1e-4);
    return (1 + c[0] * std::exp(c[1] / height)) *
           (1 + c[2] * std::exp(c[3] * angle) + c[4] * cosine_of_angle * cosine_of_angle);
}

double angle_between(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

Double3 unit(const Double3& v) {
    const double longest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    const Double3 scaled = (1 / longest) * v;
    return (1 / std::sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z)) * scaled;
}

/// The direction, or the one on the horizon above it.
Double3 above_horizon(const Double3& direction) {
    if (direction.z >= 0) return direction;
    const double across = std::hypot(direction.x, direction.y);
    return across > 0 ? Double3{direction.x / across, direction.y / across, 0} : Double3{1, 0, 0};
}

/// In the gamut.
Double3 positive(const Double3& srgb) {
    return {std::max(srgb.x, 0.0), std::max(srgb.y, 0.0), std::max(srgb.z, 0.0)};
}

/// Spectral radiance outside of the atmosphere from 380 nm in steps of 10 nm [100 W/(sr m^2 nm)].
constexpr double kSolarRadiance[] = {165.5, 162.3, 211.2, 258.8, 258.2, 242.3, 267.6, 296.6, 305.4, 300.6,
                                     306.6, 288.3, 287.1, 278.2, 271.0, 272.3, 263.6, 255.0, 250.6, 253.1,
                                     253.5, 251.3, 246.3, 241.7, 236.8, 232.1, 228.2, 223.4, 219.7, 215.3,
                                     211.0, 207.3, 202.4, 198.7, 194.3, 190.7, 186.3, 182.6};

/// Absorption of ozone at the same wavelengths [1/cm].
constexpr double kOzone[] = {0,     0,     0,     0,     0,     0,     0,     0.003, 0.006, 0.009,
                             0.014, 0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120,
                             0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048,
                             0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};
static_assert(std::size(kSolarRadiance) == std::size(kOzone));

/// Appendix A.1, without water vapour and mixed gases, which absorb beyond 690 nm and hardly visible light.
Double3 radiance_of_sun(double turbidity, double cosine) {
    const double from_zenith = angle_between(cosine);
    const double air_mass =
        1 / (std::max(cosine, 0.0) + 0.15 * std::pow(93.885 - from_zenith * 180 / kPi, -1.253));
    const double haze = 0.04608365822050 * turbidity - 0.04586025928522;
    constexpr double kOzoneColumn = 0.35; // [cm]
    std::vector<SpectrumSample> samples;
    for (std::size_t k = 0; k < std::size(kSolarRadiance); ++k) {
        const double wavelength = 380 + 10 * static_cast<double>(k);
        const double micrometres = wavelength / 1000;
        const double depth = 0.008735 * std::pow(micrometres, -4.08) + haze * std::pow(micrometres, -1.3) +
                             kOzoneColumn * kOzone[k];
        samples.push_back({wavelength, 100 * kSolarRadiance[k] * std::exp(-air_mass * depth)});
    }
    // A constant spectrum of 1 W/(sr m^2 nm) has 683 lm/W times the integral of the luminosity function, 106.857 nm.
    constexpr double kLumensPerConstant = 683 * 106.857;
    return positive(kLumensPerConstant / kLumensPerWatt * srgb_of(samples, SpectrumUse::illuminant));
}

} // namespace

PreethamSky::PreethamSky(double turbidity, const Double3& to_sun)
    : turbidity_(std::clamp(turbidity, kLeastTurbidity, kMostTurbidity)),
      to_sun_(above_horizon(unit(to_sun))) {
    const double angle = angle_between(to_sun_.z);
    const double chi = (4.0 / 9 - turbidity_ / 120) * (kPi - 2 * angle);
    zenith_[0] = 1000 * ((4.0453 * turbidity_ - 4.9710) * std::tan(chi) - 0.2155 * turbidity_ + 2.4192);
    for (int k = 0; k < 2; ++k) {
        double sum = 0;
        for (const auto& row : kZenith[k])
            sum = sum * turbidity_ + ((row[0] * angle + row[1]) * angle + row[2]) * angle + row[3];
        zenith_[k + 1] = sum;
    }
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 5; ++i) coefficients_[k][i] = kPerez[k][i][0] * turbidity_ + kPerez[k][i][1];
        over_perez_[k] = zenith_[k] / perez(coefficients_[k], 1, angle, to_sun_.z);
    }
    sun_radiance_ = radiance_of_sun(turbidity_, to_sun_.z);
}

Double3 PreethamSky::sky_radiance(const Double3& direction) const {
    const Double3 w = above_horizon(direction);
    const double cosine = w.x * to_sun_.x + w.y * to_sun_.y + w.z * to_sun_.z;
    const double angle = angle_between(cosine);
    double value[3];
    for (int k = 0; k < 3; ++k) value[k] = over_perez_[k] * perez(coefficients_[k], w.z, angle, cosine);
    return positive(value[0] / kLumensPerWatt * srgb_from_xyz(xyz_of({value[1], value[2]})));
}

bool PreethamSky::is_in_sun(const Double3& direction) const {
    const Double3 offset = direction - to_sun_;
    const double half = 2 * std::sin(kSunRadius / 2);
    return offset.x * offset.x + offset.y * offset.y + offset.z * offset.z <= half * half;
}

} // namespace nusselt::scene
