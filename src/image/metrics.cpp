#include "image/metrics.h"

#include <cmath>
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
                             size_text(reference) + " of the reference; render both at one size");
}

Comparison compare(const Image& a, const Image& reference) {
    require_same_size(a, reference);
    Comparison result;
    double sum_a = 0;
    double sum_b = 0;
    double sum_squares = 0;
    double sum_relative_squares = 0;
    const float* rgb_a = a.pixels.data();
    const float* rgb_b = reference.pixels.data();
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x, rgb_a += 3, rgb_b += 3) {
            record_if_invalid(result.invalid_a, rgb_a, x, y);
            record_if_invalid(result.invalid_b, rgb_b, x, y);
            if (!is_valid_pixel(rgb_a) || !is_valid_pixel(rgb_b)) continue;
            ++result.compared_pixels;
            for (int c = 0; c < 3; ++c) {
                const double value = rgb_a[c];
                const double expected = rgb_b[c];
                const double square = (value - expected) * (value - expected);
                sum_a += value;
                sum_b += expected;
                sum_squares += square;
                sum_relative_squares += square / (expected * expected + kRelativeMseEpsilon);
            }
        }
    }
    const double value_count = 3 * double(result.compared_pixels);
    result.mse = sum_squares / value_count;
    result.rmse = std::sqrt(result.mse);
    result.rel_mse = sum_relative_squares / value_count;
    result.mean_a = sum_a / value_count;
    result.mean_b = sum_b / value_count;
    result.relative_rmse = result.rmse / result.mean_b;
    return result;
}

} // namespace nusselt::image
