#include "image/ssim.h"

#include "image/metrics.h"
#include "image/planes.h"
#include "image/srgb.h"

#include <cmath>
#include <limits>

namespace nusselt::image {

namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01;
constexpr double kC2 = 0.03 * 0.03;

Plane displayed_luma(const Image& image, const std::vector<char>& valid, double scale) {
    Plane luma = make_plane(image.width, image.height);
    for_each_row(image.height, [&](int y) {
        const std::size_t begin = std::size_t(y) * std::size_t(image.width);
        for (std::size_t i = begin; i < begin + std::size_t(image.width); ++i) {
            if (!valid[i]) continue;
            const float* rgb = &image.pixels[3 * i];
            luma.values[i] = 0.299 * display_code(scale * double(rgb[0])) +
                             0.587 * display_code(scale * double(rgb[1])) +
                             0.114 * display_code(scale * double(rgb[2]));
        }
    });
    return luma;
}

Plane product(const Plane& a, const Plane& b) {
    Plane result = a;
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] *= b.values[i];
    return result;
}

std::vector<double> gaussian_weights() {
    std::vector<double> weights;
    double sum = 0;
    for (int i = -kRadius; i <= kRadius; ++i) {
        weights.push_back(std::exp(-i * i / (2 * kSigma * kSigma)));
        sum += weights.back();
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

} // namespace

double psnr(const Image& a, const Image& reference, double exposure) {
    require_same_size(a, reference);
    const double scale = std::exp2(exposure);
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
        if (!is_valid_pixel(&a.pixels[i]) || !is_valid_pixel(&reference.pixels[i])) continue;
        for (std::size_t c = i; c < i + 3; ++c) {
            const double difference =
                display_code(scale * double(a.pixels[c])) - display_code(scale * double(reference.pixels[c]));
            sum += difference * difference;
        }
        count += 3;
    }
    return count > 0 ? -10 * std::log10(sum / count) : std::numeric_limits<double>::quiet_NaN();
}

double ssim(const Image& a, const Image& reference, double exposure) {
    const std::vector<char> valid = valid_in_both(a, reference);
    const Plane x = displayed_luma(a, valid, std::exp2(exposure));
    const Plane y = displayed_luma(reference, valid, std::exp2(exposure));
    const std::vector<double> weights = gaussian_weights();
    const auto window_means = [&](const Plane& plane) { return filtered(plane, weights, weights); };
    const Plane mean_x = window_means(x);
    const Plane mean_y = window_means(y);
    const Plane mean_xx = window_means(product(x, x));
    const Plane mean_yy = window_means(product(y, y));
    const Plane mean_xy = window_means(product(x, y));

    double sum = 0;
    double count = 0;
    for (int row = kRadius; row < a.height - kRadius; ++row) {
        for (int column = kRadius; column < a.width - kRadius; ++column) {
            const std::size_t i = std::size_t(row) * std::size_t(a.width) + std::size_t(column);
            if (!valid[i]) continue;
            const double mx = mean_x.values[i];
            const double my = mean_y.values[i];
            const double variance_x = mean_xx.values[i] - mx * mx;
            const double variance_y = mean_yy.values[i] - my * my;
            const double covariance = mean_xy.values[i] - mx * my;
            sum += (2 * mx * my + kC1) * (2 * covariance + kC2) /
                   ((mx * mx + my * my + kC1) * (variance_x + variance_y + kC2));
            ++count;
        }
    }
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

} // namespace nusselt::image
