#include "lab/errors/image_errors.h"

#include "image/metrics.h"

#include <algorithm>
#include <cmath>

namespace nusselt::lab {

namespace {

bool contains(const Inset& inset, double x, double y) {
    return x >= inset.left && x < inset.right && y >= inset.top && y < inset.bottom;
}

} // namespace

double mean_square_difference(const image::Image& a, const image::Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double difference = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
        sum += difference * difference;
    }
    return sum / static_cast<double>(a.pixels.size());
}

double mean_radiance(const image::Image& image) {
    double sum = 0;
    for (const float value : image.pixels) sum += static_cast<double>(value);
    return sum / static_cast<double>(image.pixels.size());
}

void ImageErrorSums::Sums::add(const Sums& part) {
    squares += part.squares;
    clamped_squares += part.clamped_squares;
    differences += part.differences;
    reference += part.reference;
    count += part.count;
}

RegionErrors ImageErrorSums::Sums::errors() const {
    RegionErrors errors;
    errors.rmse = std::sqrt(squares / count);
    errors.rmse_clamped = std::sqrt(clamped_squares / count);
    errors.relative_rmse = errors.rmse / (reference / count);
    errors.relative_bias = differences / reference;
    return errors;
}

ImageErrorSums::ImageErrorSums(const image::Image& reference, const std::vector<bool>& outside_penumbrae,
                               const std::vector<Inset>& insets)
    : reference_(reference),
      outside_penumbrae_(outside_penumbrae),
      insets_(insets),
      in_insets_(insets.size()) {}

void ImageErrorSums::add(const image::Image& frame) {
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const auto pixel = static_cast<std::size_t>(y * frame.width + x);
            const float* value = &frame.pixels[3 * pixel];
            if (!image::is_valid_pixel(value)) {
                ++invalid_pixels_;
                continue;
            }
            const float* expected = &reference_.pixels[3 * pixel];
            Sums sums;
            sums.count = 3;
            for (int c = 0; c < 3; ++c) {
                const double difference = static_cast<double>(value[c]) - static_cast<double>(expected[c]);
                const double clamped =
                    static_cast<double>(std::min(value[c], 1.0f) - std::min(expected[c], 1.0f));
                sums.squares += difference * difference;
                sums.clamped_squares += clamped * clamped;
                sums.differences += difference;
                sums.reference += static_cast<double>(expected[c]);
            }
            frame_.add(sums);
            if (outside_penumbrae_[pixel]) outside_.add(sums);
            for (std::size_t i = 0; i < insets_.size(); ++i)
                if (contains(insets_[i], (x + 0.5) / frame.width, (y + 0.5) / frame.height))
                    in_insets_[i].add(sums);
        }
    }
}

ImageErrors ImageErrorSums::errors() const {
    ImageErrors errors;
    errors.frame = frame_.errors();
    for (const Sums& inset : in_insets_) errors.insets.push_back(inset.errors());
    errors.rmse_outside_penumbrae = outside_.errors().rmse / mean_radiance(reference_);
    errors.invalid_pixels = invalid_pixels_;
    return errors;
}

} // namespace nusselt::lab
