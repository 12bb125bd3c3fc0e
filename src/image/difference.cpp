#include "image/difference.h"

#include "image/metrics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace nusselt::image {

namespace {

/// a - b in the channel where it is largest.
double signed_difference(const float* a, const float* b) {
    double result = 0;
    for (int c = 0; c < 3; ++c) {
        const double difference = double(a[c]) - double(b[c]);
        if (std::abs(difference) > std::abs(result)) result = difference;
    }
    return result;
}

/// Lightness and two opponent axes (green to red, blue to yellow), see
/// B. Ottosson 2020, A perceptual color space for image processing, https://bottosson.github.io/posts/oklab/
struct Oklab {
    double lightness, a, b;
};

double cube(double x) { return x * x * x; }

std::array<double, 3> linear_rgb(const Oklab& color) {
    const double l = cube(color.lightness + 0.3963377774 * color.a + 0.2158037573 * color.b);
    const double m = cube(color.lightness - 0.1055613458 * color.a - 0.0638541728 * color.b);
    const double s = cube(color.lightness - 0.0894841775 * color.a - 1.2914855480 * color.b);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

/// \param t  in [-1, 1]
std::array<double, 3> diverging_color(double t) {
    // Both of lightness 0.5 and chroma 0.19, at the hues 262 and 27 degrees. This is about the strongest pair
    // for which both lines from white stay inside the gamut of sRGB.
    constexpr Oklab kBlue = {0.5, -0.0264, -0.1881};
    constexpr Oklab kRed = {0.5, 0.1693, 0.0863};
    const Oklab& end = t < 0 ? kBlue : kRed;
    const double amount = std::abs(t);
    return linear_rgb({1 + amount * (end.lightness - 1), amount * end.a, amount * end.b});
}

/// \param t  in [0, 1]
std::array<double, 3> error_color(double t) {
    // The hue turns from 280 degrees (violet) upwards to 85 (yellow). This chroma is about the largest for which
    // the whole curve stays inside the gamut of sRGB.
    constexpr double kDegree = std::numbers::pi / 180;
    const double hue = (280 + 165 * t) * kDegree;
    const double chroma = 0.16 * std::sin(std::numbers::pi * t);
    return linear_rgb({0.98 * t, chroma * std::cos(hue), chroma * std::sin(hue)});
}

} // namespace

double difference_scale(const Image& a, const Image& reference) {
    require_same_size(a, reference);
    std::vector<double> differences;
    differences.reserve(a.pixels.size() / 3);
    for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
        if (is_valid_pixel(&a.pixels[i]) && is_valid_pixel(&reference.pixels[i]))
            differences.push_back(std::abs(signed_difference(&a.pixels[i], &reference.pixels[i])));
    }
    if (differences.empty()) return 1;
    const std::size_t rank = (differences.size() - 1) * 99 / 100;
    const auto percentile = differences.begin() + std::ptrdiff_t(rank);
    std::nth_element(differences.begin(), percentile, differences.end());
    if (*percentile > 0) return *percentile;
    const double largest = *std::max_element(percentile, differences.end());
    return largest > 0 ? largest : 1;
}

Image signed_difference_image(const Image& a, const Image& reference, double scale) {
    assert(scale > 0);
    require_same_size(a, reference);
    Image result = make_image(a.width, a.height);
    for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
        if (!is_valid_pixel(&a.pixels[i]) || !is_valid_pixel(&reference.pixels[i])) continue;
        const double difference = signed_difference(&a.pixels[i], &reference.pixels[i]);
        const std::array<double, 3> color = diverging_color(std::clamp(difference / scale, -1.0, 1.0));
        for (std::size_t c = 0; c < 3; ++c) result.pixels[i + c] = float(color[c]);
    }
    return result;
}

Image absolute_difference_image(const Image& a, const Image& reference, double scale) {
    assert(scale > 0);
    const std::vector<char> valid = valid_in_both(a, reference);
    Image result = make_image(a.width, a.height);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const double difference = std::abs(double(a.pixels[i]) - double(reference.pixels[i]));
        if (valid[i / 3]) result.pixels[i] = float(difference / scale);
    }
    return result;
}

Image error_map_image(const Plane& map) {
    Image result = make_image(map.width, map.height);
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const std::array<double, 3> color = error_color(std::clamp(map.values[i], 0.0, 1.0));
        for (std::size_t c = 0; c < 3; ++c) result.pixels[3 * i + c] = float(color[c]);
    }
    return result;
}

} // namespace nusselt::image
