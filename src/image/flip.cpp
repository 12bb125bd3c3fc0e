#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace nusselt::image {

namespace {

using Color = std::array<double, 3>;

/// An image in some colour space, channel by channel.
using Planes = std::array<Plane, 3>;

constexpr double kColorExponent = 0.7;   // q_c
constexpr double kColorKnee = 0.4;       // p_c, fraction of the largest error
constexpr double kColorKneeError = 0.95; // p_t, what is assigned to it
constexpr double kFeatureExponent = 0.5; // q_f
constexpr double kFeatureWidth = 0.082;  // w, degrees from the minimum to the maximum of the filter of edges

/// Primaries of sRGB as fractions, row by row; the white point is their sum.
constexpr double kXyzFromRgb[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                      {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                      {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};

/// X, Y and Z relative to those of white.
Color relative_xyz(const Color& rgb) {
    Color xyz = {};
    for (std::size_t i = 0; i < 3; ++i) {
        const double* row = kXyzFromRgb[i];
        xyz[i] = (row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2]) / (row[0] + row[1] + row[2]);
    }
    return xyz;
}

/// The inverse of the matrix of relative_xyz(), by Cramer's rule.
std::array<Color, 3> rgb_from_relative_xyz() {
    std::array<Color, 3> columns = {relative_xyz({1, 0, 0}), relative_xyz({0, 1, 0}),
                                    relative_xyz({0, 0, 1})};
    const auto cross = [](const Color& a, const Color& b) {
        return Color{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const Color& a, const Color& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    std::array<Color, 3> inverse = {cross(columns[1], columns[2]), cross(columns[2], columns[0]),
                                    cross(columns[0], columns[1])};
    const double determinant = dot(columns[0], inverse[0]);
    for (Color& row : inverse)
        for (double& value : row) value /= determinant;
    return inverse;
}

/// Linear opponent space: achromatic, red to green, blue to yellow.
Color ycxcz_from_xyz(const Color& xyz) {
    return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

Color xyz_from_ycxcz(const Color& ycxcz) {
    const double y = (ycxcz[0] + 16) / 116;
    return {y + ycxcz[1] / 500, y, y - ycxcz[2] / 200};
}

/// CIELAB with chroma times lightness / 100, for the Hunt effect: dark colours look less colourful.
Color hunt_adjusted_lab(const Color& rgb) {
    const Color xyz = relative_xyz(rgb);
    Color f = {};
    for (std::size_t i = 0; i < 3; ++i) {
        constexpr double kDelta = 6.0 / 29;
        f[i] =
            xyz[i] > kDelta * kDelta * kDelta ? std::cbrt(xyz[i]) : xyz[i] / (3 * kDelta * kDelta) + 4.0 / 29;
    }
    const double lightness = 116 * f[1] - 16;
    return {lightness, 0.01 * lightness * 500 * (f[0] - f[1]), 0.01 * lightness * 200 * (f[1] - f[2])};
}

/// A distance for large differences: lightness and chroma are added, not squared.
double hyab(const Color& a, const Color& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// Distances to [0, 1]: large ones are squeezed between the knee and 1.
double redistributed(double distance) {
    static const double largest =
        std::pow(hyab(hunt_adjusted_lab({0, 1, 0}), hunt_adjusted_lab({0, 0, 1})), kColorExponent);
    const double error = std::pow(distance, kColorExponent);
    const double knee = kColorKnee * largest;
    if (error < knee) return kColorKneeError / knee * error;
    return kColorKneeError + (error - knee) / (largest - knee) * (1 - kColorKneeError);
}

std::vector<double> normalized(std::vector<double> weights) {
    double sum = 0;
    for (const double weight : weights) sum += weight;
    for (double& weight : weights) weight /= sum;
    return weights;
}

/// exp(-pi^2 x^2 / b) for x in degrees: one Gaussian of a contrast sensitivity function in space, for one axis.
std::vector<double> sensitivity_weights(double b, double pixels_per_degree) {
    constexpr double kWidest = 0.04; // the largest b of all channels, which share their radius
    constexpr double kPi = std::numbers::pi;
    const int radius = int(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixels_per_degree));
    std::vector<double> weights;
    for (int i = -radius; i <= radius; ++i) {
        const double x = i / pixels_per_degree;
        weights.push_back(std::exp(-kPi * kPi * x * x / b));
    }
    return weights;
}

double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum;
}

/// The filter of one channel: a sum of Gaussians, together of weight 1.
Plane seen(const Plane& channel, double b, double pixels_per_degree) {
    const std::vector<double> weights = normalized(sensitivity_weights(b, pixels_per_degree));
    return filtered(channel, weights, weights);
}

/// Blue to yellow is the only channel with two Gaussians: amplitudes 34.1 and 13.5, b 0.04 and 0.025.
Plane seen_blue_yellow(const Plane& channel, double pixels_per_degree) {
    constexpr std::array<std::array<double, 2>, 2> kAmplitudes = {{{34.1, 0.04}, {13.5, 0.025}}};
    std::array<double, 2> shares = {};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto [amplitude, b] = kAmplitudes[i];
        const double sum = sum_of(sensitivity_weights(b, pixels_per_degree));
        shares[i] = amplitude * std::sqrt(std::numbers::pi / b) * sum * sum;
    }
    Plane wide = seen(channel, kAmplitudes[0][1], pixels_per_degree);
    const Plane narrow = seen(channel, kAmplitudes[1][1], pixels_per_degree);
    for (std::size_t i = 0; i < wide.values.size(); ++i)
        wide.values[i] =
            (shares[0] * wide.values[i] + shares[1] * narrow.values[i]) / (shares[0] + shares[1]);
    return wide;
}

/// The colours that an observer sees, in Hunt-adjusted CIELAB.
Planes seen_colors(const Planes& ycxcz, double pixels_per_degree) {
    static const std::array<Color, 3> rgb_from_xyz = rgb_from_relative_xyz();
    Planes planes = {seen(ycxcz[0], 0.0047, pixels_per_degree), seen(ycxcz[1], 0.0053, pixels_per_degree),
                     seen_blue_yellow(ycxcz[2], pixels_per_degree)};
    for_each_row(planes[0].height, [&](int y) {
        for (int x = 0; x < planes[0].width; ++x) {
            const Color xyz = xyz_from_ycxcz({planes[0].row(y)[x], planes[1].row(y)[x], planes[2].row(y)[x]});
            Color rgb = {};
            for (std::size_t i = 0; i < 3; ++i) {
                const Color& row = rgb_from_xyz[i];
                rgb[i] = std::clamp(row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2], 0.0, 1.0);
            }
            const Color lab = hunt_adjusted_lab(rgb);
            for (std::size_t i = 0; i < 3; ++i) planes[i].row(y)[x] = lab[i];
        }
    });
    return planes;
}

/// Weights along one axis of the detectors of edges and points: a Gaussian and its derivatives. Those of
/// the derivatives are scaled so that in the two-dimensional filter positive and negative weights have sums of
/// 1 and -1.
struct FeatureWeights {
    std::vector<double> gaussian, first_derivative, second_derivative;
};

FeatureWeights feature_weights(double pixels_per_degree) {
    const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
    const int radius = int(std::ceil(3 * sigma));
    FeatureWeights weights;
    for (int i = -radius; i <= radius; ++i) {
        const double gaussian = std::exp(-i * i / (2 * sigma * sigma));
        weights.gaussian.push_back(gaussian);
        weights.first_derivative.push_back(-i * gaussian);
        weights.second_derivative.push_back((i * i / (sigma * sigma) - 1) * gaussian);
    }
    weights.gaussian = normalized(weights.gaussian);
    for (std::vector<double>* derivative : {&weights.first_derivative, &weights.second_derivative}) {
        double positive = 0;
        double negative = 0;
        for (const double weight : *derivative) (weight > 0 ? positive : negative) += weight;
        for (double& weight : *derivative) weight /= weight > 0 ? positive : -negative;
    }
    return weights;
}

/// Strengths of edges and of points.
std::array<Plane, 2> features(const Plane& achromatic, double pixels_per_degree) {
    const FeatureWeights weights = feature_weights(pixels_per_degree);
    Plane brightness = achromatic;
    for (double& value : brightness.values) value = (value + 16) / 116;
    const auto strength = [&](const std::vector<double>& derivative) {
        Plane along_x = filtered(brightness, derivative, weights.gaussian);
        const Plane along_y = filtered(brightness, weights.gaussian, derivative);
        for (std::size_t i = 0; i < along_x.values.size(); ++i)
            along_x.values[i] = std::hypot(along_x.values[i], along_y.values[i]);
        return along_x;
    };
    return {strength(weights.first_derivative), strength(weights.second_derivative)};
}

/// FLIP of two images in linear opponent space.
Plane flip_of_opponents(const Planes& a, const Planes& reference, double pixels_per_degree) {
    const Planes colors_a = seen_colors(a, pixels_per_degree);
    const Planes colors_b = seen_colors(reference, pixels_per_degree);
    const std::array<Plane, 2> features_a = features(a[0], pixels_per_degree);
    const std::array<Plane, 2> features_b = features(reference[0], pixels_per_degree);
    Plane result = make_plane(a[0].width, a[0].height);
    for_each_row(result.height, [&](int y) {
        const std::size_t begin = std::size_t(y) * std::size_t(result.width);
        for (std::size_t i = begin; i < begin + std::size_t(result.width); ++i) {
            const auto color = [i](const Planes& planes) {
                return Color{planes[0].values[i], planes[1].values[i], planes[2].values[i]};
            };
            const double color_error = redistributed(hyab(color(colors_a), color(colors_b)));
            double feature_difference = 0;
            for (std::size_t f = 0; f < 2; ++f) {
                const double difference = std::abs(features_a[f].values[i] - features_b[f].values[i]);
                feature_difference = std::max(feature_difference, difference);
            }
            const double feature_error = std::pow(feature_difference / std::numbers::sqrt2, kFeatureExponent);
            result.values[i] = std::clamp(std::pow(color_error, 1 - feature_error), 0.0, 1.0);
        }
    });
    return result;
}

/// An image in linear opponent space after `display`, which maps one linear value to [0, 1].
template <class Display>
Planes opponents(const Image& image, const std::vector<char>& valid, const Display& display) {
    Planes planes;
    planes.fill(make_plane(image.width, image.height));
    for_each_row(image.height, [&](int y) {
        const std::size_t begin = std::size_t(y) * std::size_t(image.width);
        for (std::size_t i = begin; i < begin + std::size_t(image.width); ++i) {
            Color rgb = {};
            if (valid[i])
                for (std::size_t c = 0; c < 3; ++c) rgb[c] = display(double(image.pixels[3 * i + c]));
            const Color ycxcz = ycxcz_from_xyz(relative_xyz(rgb));
            for (std::size_t c = 0; c < 3; ++c) planes[c].values[i] = ycxcz[c];
        }
    });
    return planes;
}

// The curve of ACES by Narkowicz is (n2 x^2 + n1 x) / (d2 x^2 + d1 x + d0); its exposure of 0.6 is in here.
constexpr double kN2 = 0.6 * 0.6 * 2.51, kN1 = 0.6 * 0.03;
constexpr double kD2 = 0.6 * 0.6 * 2.43, kD1 = 0.6 * 0.59, kD0 = 0.14;

double aces(double x) { return std::clamp((kN2 * x + kN1) * x / ((kD2 * x + kD1) * x + kD0), 0.0, 1.0); }

/// The x with aces(x) = y, for y in (0, 1).
double inverse_aces(double y) {
    const double a = kN2 - y * kD2;
    const double half_b = 0.5 * (kN1 - y * kD1);
    return (-half_b + std::sqrt(half_b * half_b + a * y * kD0)) / a;
}

constexpr double kLargestLuminance = 65536;

} // namespace

Plane flip(const Image& a, const Image& reference, double pixels_per_degree, double exposure) {
    assert(pixels_per_degree > 0 && pixels_per_degree <= kFlipMaxPixelsPerDegree);
    const std::vector<char> valid = valid_in_both(a, reference);
    const double scale = std::exp2(exposure);
    const auto display = [scale](double value) { return std::clamp(scale * value, 0.0, 1.0); };
    return flip_of_opponents(opponents(a, valid, display), opponents(reference, valid, display),
                             pixels_per_degree);
}

FlipExposures flip_exposures(const Image& reference) {
    constexpr double kSmallestLuminance = 0x1p-24;
    const std::vector<char> valid = valid_in_both(reference, reference);
    std::vector<double> luminances;
    for (std::size_t i = 0; i < valid.size(); ++i) {
        if (!valid[i]) continue;
        const float* rgb = &reference.pixels[3 * i];
        luminances.push_back(std::clamp(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2],
                                        kSmallestLuminance, kLargestLuminance));
    }
    if (luminances.empty()) return {};
    std::sort(luminances.begin(), luminances.end());
    const std::size_t half = luminances.size() / 2;
    const double median =
        luminances.size() % 2 == 1 ? luminances[half] : 0.5 * (luminances[half - 1] + luminances[half]);
    const double bright = inverse_aces(0.85);
    const double first = std::log2(bright / luminances.back());
    const double last = std::log2(bright / median);
    return {first, last, std::max(2, int(std::ceil(last - first)))};
}

Plane hdr_flip(const Image& a, const Image& reference, const FlipExposures& exposures,
               double pixels_per_degree) {
    assert(pixels_per_degree > 0 && pixels_per_degree <= kFlipMaxPixelsPerDegree);
    const std::vector<char> valid = valid_in_both(a, reference);
    Plane result = make_plane(a.width, a.height);
    for (int i = 0; i < exposures.count; ++i) {
        const double step = (exposures.last - exposures.first) / (exposures.count - 1);
        const double scale = std::exp2(exposures.first + i * step);
        const auto display = [scale](double value) {
            return aces(scale * std::clamp(value, 0.0, kLargestLuminance));
        };
        const Plane error = flip_of_opponents(opponents(a, valid, display),
                                              opponents(reference, valid, display), pixels_per_degree);
        for (std::size_t p = 0; p < result.values.size(); ++p)
            result.values[p] = std::max(result.values[p], error.values[p]);
    }
    return result;
}

double mean_of_valid(const Plane& map, const Image& a, const Image& reference) {
    const std::vector<char> valid = valid_in_both(a, reference);
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < valid.size(); ++i) {
        if (!valid[i]) continue;
        sum += map.values[i];
        ++count;
    }
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

} // namespace nusselt::image
