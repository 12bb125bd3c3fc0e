#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace nusselt::image {

namespace {

void record_if_invalid(InvalidPixels& invalid, const float* rgb, int x, int y) {
    if (is_valid_pixel(rgb)) return;
    ++invalid.count;
    if (std::isnan(rgb[0]) || std::isnan(rgb[1]) || std::isnan(rgb[2])) ++invalid.nan_count;
    if (invalid.first.size() < kListedInvalidPixels)
        invalid.first.push_back({x, y, {rgb[0], rgb[1], rgb[2]}});
}

std::string size_text(const Image& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

} // namespace

bool is_valid_pixel(const float* rgb) {
    return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

void require_same_size(const Image& a, const Image& reference) {
    if (a.width == reference.width && a.height == reference.height) return;
    throw std::runtime_error("the images differ in size: " + size_text(a) + " pixels against " +
                             size_text(reference) + " of the reference; render both at the same size");
}

Comparison compare(const Image& a, const Image& reference) {
    require_same_size(a, reference);
    Comparison result;
    double sum_a = 0;
    double sum_b = 0;
    double sum_squares = 0;
    double sum_absolute = 0;
    double sum_relative_squares = 0;
    double sum_relative_pixels = 0;
    const float* rgb_a = a.pixels.data();
    const float* rgb_b = reference.pixels.data();
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x, rgb_a += 3, rgb_b += 3) {
            record_if_invalid(result.invalid_a, rgb_a, x, y);
            record_if_invalid(result.invalid_b, rgb_b, x, y);
            if (!is_valid_pixel(rgb_a) || !is_valid_pixel(rgb_b)) continue;
            ++result.compared_pixels;
            double pixel_square = 0;
            double pixel_expected = 0;
            for (int c = 0; c < 3; ++c) {
                const double value = rgb_a[c];
                const double expected = rgb_b[c];
                const double square = (value - expected) * (value - expected);
                sum_a += value;
                sum_b += expected;
                sum_absolute += std::abs(value - expected);
                sum_relative_squares += square / (expected * expected + kRelativeMseEpsilon);
                pixel_square += square;
                pixel_expected += expected * expected;
            }
            sum_squares += pixel_square;
            sum_relative_pixels += pixel_square / (pixel_expected + kRelativeMseEpsilon);
        }
    }
    const auto mean = [](double sum, double count) {
        return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
    };
    const double value_count = 3 * double(result.compared_pixels);
    result.mse = mean(sum_squares, value_count);
    result.rmse = std::sqrt(result.mse);
    result.mae = mean(sum_absolute, value_count);
    result.rel_mse = mean(sum_relative_squares, value_count);
    result.mrse = mean(sum_relative_pixels, double(result.compared_pixels));
    result.mean_a = mean(sum_a, value_count);
    result.mean_b = mean(sum_b, value_count);
    result.relative_rmse = result.rmse == 0 ? 0 : result.rmse / std::fabs(result.mean_b);
    return result;
}

double differing_share(const Image& a, const Image& reference, double tolerance, double darkest) {
    require_same_size(a, reference);
    const double size = static_cast<double>(reference.pixels.size());
    double mean = 0;
    for (const float value : reference.pixels) mean += value / size;
    const auto differs = [&](std::size_t i) {
        const double difference = std::fabs(static_cast<double>(a.pixels[i]) - reference.pixels[i]);
        const double limit = tolerance * std::max<double>(std::fabs(reference.pixels[i]), darkest * mean);
        return !(difference <= limit) || !std::isfinite(limit);
    };
    std::size_t count = 0;
    for (std::size_t i = 0; i < reference.pixels.size(); i += 3)
        count += differs(i) || differs(i + 1) || differs(i + 2);
    return static_cast<double>(count) / (size / 3);
}

} // namespace nusselt::image
