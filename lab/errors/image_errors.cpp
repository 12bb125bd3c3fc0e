#include "lab/errors/image_errors.h"

#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace nusselt::lab {

namespace {

bool contains(const Inset& inset, double x, double y) {
    return x >= inset.left && x < inset.right && y >= inset.top && y < inset.bottom;
}

/// Weights of the pixels at distances of 0, 1, ... from the middle.
std::vector<double> gaussian_weights(double deviation) {
    std::vector<double> weights;
    for (int i = 0; i <= static_cast<int>(std::ceil(3 * deviation)); ++i)
        weights.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
    return weights;
}

/// Blurs along one axis.
/// \param length of the axis, with `stride` numbers from one pixel to the next.
void blur_line(const float* from, float* to, int length, std::ptrdiff_t stride,
               const std::vector<double>& weights) {
    const int radius = static_cast<int>(weights.size()) - 1;
    for (int i = 0; i < length; ++i) {
        double sum = 0, weight = 0;
        for (int k = std::max(i - radius, 0); k <= std::min(i + radius, length - 1); ++k) {
            const double here = weights[static_cast<std::size_t>(std::abs(k - i))];
            sum += here * static_cast<double>(from[k * stride]);
            weight += here;
        }
        to[i * stride] = static_cast<float>(sum / weight);
    }
}

} // namespace

image::Image blurred(const image::Image& image, double deviation) {
    const std::vector<double> weights = gaussian_weights(deviation);
    image::Image rows = image;
    image::Image result = image;
    const std::ptrdiff_t row = 3 * static_cast<std::ptrdiff_t>(image.width);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < image.height; ++y)
            blur_line(&image.pixels[0] + y * row + c, &rows.pixels[0] + y * row + c, image.width, 3, weights);
        for (int x = 0; x < image.width; ++x)
            blur_line(&rows.pixels[0] + 3 * x + c, &result.pixels[0] + 3 * x + c, image.height, row, weights);
    }
    return result;
}

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
                               const std::vector<Inset>& insets, double blur)
    : reference_(reference),
      outside_penumbrae_(outside_penumbrae),
      insets_(insets),
      blur_(blur),
      blurred_reference_(blur > 0 ? blurred(reference, blur) : image::Image()),
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
            (outside_penumbrae_[pixel] ? outside_ : inside_).add(sums);
            for (std::size_t i = 0; i < insets_.size(); ++i)
                if (contains(insets_[i], (x + 0.5) / frame.width, (y + 0.5) / frame.height))
                    in_insets_[i].add(sums);
        }
    }
    if (blur_ > 0) blurred_squares_ += mean_square_difference(blurred(frame, blur_), blurred_reference_);
    ++frames_;
}

ImageErrors ImageErrorSums::errors() const {
    ImageErrors errors;
    errors.frame = frame_.errors();
    for (const Sums& inset : in_insets_) errors.insets.push_back(inset.errors());
    const double mean = mean_radiance(reference_);
    errors.rmse_outside_penumbrae = outside_.errors().rmse / mean;
    errors.rmse_in_penumbrae = inside_.errors().rmse / mean;
    errors.rmse_blurred = blur_ > 0 ? std::sqrt(blurred_squares_ / frames_) / mean : std::nan("");
    errors.invalid_pixels = invalid_pixels_;
    return errors;
}

} // namespace nusselt::lab
