#include "scene/colour/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nusselt::scene {

namespace {

// Integrals are sums over bins of 1 nm.
constexpr int kFirstWavelength = 360;
constexpr std::size_t kBins = 470;

using Weights = std::array<Double3, kBins>;

double bin_centre(std::size_t bin) { return kFirstWavelength + 0.5 + static_cast<double>(bin); }

/// A Gaussian with different widths on its two sides.
double lobe(double wavelength, double centre, double width_below, double width_above) {
    const double x = (wavelength - centre) / (wavelength < centre ? width_below : width_above);
    return std::exp(-0.5 * x * x);
}

/// The CIE 1931 colour matching functions, in the fit by sums of lobes of C. Wyman, P.-P. Sloan and P. Shirley, Simple
/// Analytic Approximations to the CIE XYZ Color Matching Functions, Journal of Computer Graphics Techniques 2(2), 2013.
Double3 colour_matching(double w) {
    return {1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) -
                0.065 * lobe(w, 501.1, 20.4, 26.2),
            0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1),
            1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8)};
}

/// CIE standard illuminant D65, relative spectral power from 380 nm in steps of 10 nm.
double daylight(double wavelength) {
    static constexpr double kPower[] = {
        49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923,
        108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880, 88.6856,
        90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091,
        74.3490, 61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828};
    constexpr double kLast = std::size(kPower) - 1;
    const double x = std::clamp((wavelength - 380) / 10, 0.0, kLast);
    const auto i = static_cast<std::size_t>(std::min(x, kLast - 1));
    return std::lerp(kPower[i], kPower[i + 1], x - static_cast<double>(i));
}

double equal_energy(double) { return 1; }

/// Weights of bins for tristimulus values under `light`, which itself has those of `white`. Scaling each of the three
/// functions takes out what little the fit lacks in their balance.
Weights make_weights(double (*light)(double), const Double3& white) {
    Weights weights;
    Double3 sum;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        weights[bin] = light(bin_centre(bin)) * colour_matching(bin_centre(bin));
        sum = sum + weights[bin];
    }
    for (Double3& w : weights) w = {w.x * white.x / sum.x, w.y * white.y / sum.y, w.z * white.z / sum.z};
    return weights;
}

const Weights& weights_for(SpectrumUse use) {
    static const Weights kAlbedo = make_weights(daylight, xyz_of(kWhiteD65));
    static const Weights kIlluminant = make_weights(equal_energy, {1, 1, 1});
    return use == SpectrumUse::albedo ? kAlbedo : kIlluminant;
}

/// The integral of a piecewise linear spectrum up to a wavelength.
class Antiderivative {
public:
    explicit Antiderivative(const std::vector<SpectrumSample>& samples) : samples_(samples) {
        integrals_.reserve(samples.size());
        integrals_.push_back(0);
        for (std::size_t i = 1; i < samples.size(); ++i)
            integrals_.push_back(integrals_.back() + 0.5 * (samples[i].value + samples[i - 1].value) *
                                                         (samples[i].wavelength - samples[i - 1].wavelength));
    }

    double operator()(double wavelength) const {
        const auto above = std::upper_bound(
            samples_.begin(), samples_.end(), wavelength,
            [](double value, const SpectrumSample& sample) { return value < sample.wavelength; });
        const SpectrumSample& first = samples_.front();
        if (above == samples_.begin()) return first.value * (wavelength - first.wavelength);
        const auto i = static_cast<std::size_t>(above - samples_.begin()) - 1;
        const SpectrumSample& begin = samples_[i];
        const double offset = wavelength - begin.wavelength;
        if (above == samples_.end()) return integrals_[i] + begin.value * offset;
        const double slope = (above->value - begin.value) / (above->wavelength - begin.wavelength);
        return integrals_[i] + offset * (begin.value + 0.5 * slope * offset);
    }

private:
    const std::vector<SpectrumSample>& samples_;
    std::vector<double> integrals_; ///< from the first sample to each of them
};

} // namespace

Double3 srgb_of(const std::vector<SpectrumSample>& samples, SpectrumUse use) {
    const Weights& weights = weights_for(use);
    const Antiderivative integral(samples);
    Double3 xyz;
    double below = integral(kFirstWavelength);
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        const double above = integral(kFirstWavelength + 1 + static_cast<double>(bin));
        xyz = xyz + (above - below) * weights[bin];
        below = above;
    }
    return srgb_from_xyz(xyz);
}

std::vector<SpectrumSample> blackbody(double kelvin) {
    constexpr double kSecondRadiationConstant = 1.438776877e7; // [nm K]
    constexpr double kWienDisplacement = 2.897771955e6;        // [nm K]
    const double peak = kWienDisplacement / kelvin;
    const auto exponential = [&](double w) { return std::expm1(kSecondRadiationConstant / (w * kelvin)); };
    std::vector<SpectrumSample> samples;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        const double w = bin_centre(bin);
        samples.push_back({w, std::pow(peak / w, 5) * exponential(peak) / exponential(w)});
    }
    return samples;
}

} // namespace nusselt::scene
