#include "image/metrics.h"
#include "image/srgb.h"
#include "image/ssim.h"
#include "image_fixture.h"

#include <cmath>
#include <limits>

namespace nusselt::image::test {

namespace {

/// A grey image whose displayed values are those of f(x, y).
template <class F>
Image displayed(int width, int height, const F& f) {
    Image image = make_image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t i = 3 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
            for (std::size_t c = i; c < i + 3; ++c) image.pixels[c] = float(linear_from_srgb(f(x, y)));
        }
    }
    return image;
}

double pattern(int x, int y) { return ((x * 7 + y * 13 + (x * y) % 11) % 64 + 32) / 128.0; }
double disturbed_pattern(int x, int y) { return pattern(x, y) + ((x * 31 + y * 17) % 9 - 4) / 64.0; }

/// Both numbers come from scikit-image 0.19.3 in Debian 12, which works on other principles (ndimage, double):
/// structural_similarity(a, b, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1)
/// and peak_signal_noise_ratio(a, b, data_range=1).
TEST(DisplayedErrors, AgreeWithScikitImage) {
    const Image a = displayed(32, 24, pattern);
    const Image b = displayed(32, 24, disturbed_pattern);
    EXPECT_NEAR(ssim(a, b), 0.9601926759416362, 1e-6);
    EXPECT_NEAR(psnr(a, b), 27.887057510271692, 1e-5);
}

/// The definition with explicit windows, as sums over pairs of pixels instead of filters.
double naive_ssim(const Image& a, const Image& b, double exposure) {
    const auto luma = [&](const Image& image, int x, int y) {
        const float* rgb = &image.pixels[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
        double code[3];
        for (int c = 0; c < 3; ++c) {
            const double v = std::min(std::max(double(rgb[c]) * std::pow(2, exposure), 0.0), 1.0);
            code[c] = v < 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
        }
        return 0.299 * code[0] + 0.587 * code[1] + 0.114 * code[2];
    };
    double sum = 0;
    int count = 0;
    for (int y0 = 0; y0 + 11 <= a.height; ++y0) {
        for (int x0 = 0; x0 + 11 <= a.width; ++x0, ++count) {
            double total = 0, mx = 0, my = 0;
            const auto each = [&](const auto& f) {
                for (int j = 0; j < 11; ++j)
                    for (int i = 0; i < 11; ++i)
                        f(std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / 4.5), luma(a, x0 + i, y0 + j),
                          luma(b, x0 + i, y0 + j));
            };
            each([&](double w, double x, double y) { total += w, mx += w * x, my += w * y; });
            mx /= total, my /= total;
            double vx = 0, vy = 0, vxy = 0;
            each([&](double w, double x, double y) {
                vx += w * (x - mx) * (x - mx) / total;
                vy += w * (y - my) * (y - my) / total;
                vxy += w * (x - mx) * (y - my) / total;
            });
            sum += (2 * mx * my + 1e-4) / (mx * mx + my * my + 1e-4) * (2 * vxy + 9e-4) / (vx + vy + 9e-4);
        }
    }
    return sum / count;
}

TEST(Ssim, IsItsDefinition) {
    const Image a = random_image(25, 19, 1);
    const Image b = random_image(25, 19, 2);
    for (const double exposure : {-3.0, 0.0, 1.5}) {
        EXPECT_NEAR(ssim(a, b, exposure), naive_ssim(a, b, exposure), 1e-9);
        EXPECT_NEAR(ssim(b, a, exposure), ssim(a, b, exposure), 1e-12) << "symmetric";
    }
}

TEST(Ssim, OfEqualAndOfConstantImages) {
    const Image image = random_image(20, 20, 1);
    EXPECT_NEAR(ssim(image, image), 1, 1e-12);
    const Image dark = displayed(20, 20, [](int, int) { return 0.25; });
    const Image light = displayed(20, 20, [](int, int) { return 0.75; });
    EXPECT_NEAR(ssim(dark, light), (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-6);
}

TEST(Ssim, WindowsAroundInvalidPixelsAreLeftOut) {
    Image a = random_image(13, 11, 1);
    const Image b = random_image(13, 11, 2);
    Image black_a = a;
    Image black_b = b;
    // The windows are centred in row 5, columns 5 to 7.
    const std::size_t center = 3 * (5 * 13 + 6);
    a.pixels[center] = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = center; i < center + 3; ++i) black_a.pixels[i] = black_b.pixels[i] = 0;
    const auto columns = [](const Image& image, int begin) {
        Image part = make_image(11, 11);
        for (std::size_t i = 0; i < part.pixels.size(); ++i)
            part.pixels[i] = image.pixels[i / 33 * 39 + std::size_t(3 * begin) + i % 33];
        return part;
    };
    const double left = ssim(columns(black_a, 0), columns(black_b, 0));
    const double right = ssim(columns(black_a, 2), columns(black_b, 2));
    EXPECT_NEAR(ssim(a, b), (left + right) / 2, 1e-12);
    EXPECT_TRUE(std::isnan(ssim(columns(a, 1), columns(b, 1)))) << "no window is left";
}

TEST(Ssim, OfSmallImagesIsNotDefined) {
    EXPECT_TRUE(std::isnan(ssim(make_image(10, 30), make_image(10, 30))));
    EXPECT_TRUE(std::isnan(ssim(make_image(30, 1), make_image(30, 1))));
}

TEST(Psnr, KnownValues) {
    const Image black = make_image(4, 4);
    const Image grey = displayed(4, 4, [](int, int) { return 0.1; });
    Image white = make_image(4, 4);
    for (float& value : white.pixels) value = 1;
    EXPECT_NEAR(psnr(grey, black), 20, 1e-5);
    EXPECT_NEAR(psnr(white, black), 0, 1e-12);
    EXPECT_EQ(psnr(grey, grey), std::numeric_limits<double>::infinity());
    // Both are clamped to white, or to black.
    Image bright = white;
    for (float& value : bright.pixels) value = 7;
    EXPECT_EQ(psnr(bright, white), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(psnr(bright, black, -10), -20 * std::log10(srgb_from_linear(7.0 / 1024)), 1e-9);
}

TEST(Psnr, InvalidPixelsAreLeftOut) {
    Image a = make_image(2, 1);
    a.pixels[4] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(psnr(a, make_image(2, 1)), std::numeric_limits<double>::infinity());
    a.pixels[0] = a.pixels[4];
    EXPECT_TRUE(std::isnan(psnr(a, make_image(2, 1))));
}

} // namespace

} // namespace nusselt::image::test
