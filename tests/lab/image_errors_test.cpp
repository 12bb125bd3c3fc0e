#include "lab/errors/image_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nusselt::lab {

namespace {

/// All channels of the pixels of a row have these values.
image::Image row(std::initializer_list<float> values) {
    image::Image image = image::make_image(static_cast<int>(values.size()), 1);
    std::size_t i = 0;
    for (const float value : values)
        for (int c = 0; c < 3; ++c) image.pixels[i++] = value;
    return image;
}

const std::vector<Inset> kInsets = {{"right half", 0.5, 0, 1, 1}};

TEST(ImageErrors, AreThoseOfAllFrames) {
    const image::Image reference = row({1, 0.5f, 2, 0.5f});
    const std::vector<bool> outside = {true, true, false, false};
    ImageErrorSums sums(reference, outside, kInsets);
    sums.add(row({1, 0.5f, 4, 0.5f}));    // 2 too bright, of which a screen shows nothing
    sums.add(row({0.8f, 0.5f, 2, 0.1f})); // 0.2 and 0.4 too dark
    const ImageErrors errors = sums.errors();
    // Eight pixels in two frames; the mean of the reference is 1, in the right half 1.25.
    EXPECT_NEAR(errors.frame.rmse, std::sqrt((4 + 0.04 + 0.16) / 8), 1e-6);
    EXPECT_NEAR(errors.frame.rmse_clamped, std::sqrt((0.04 + 0.16) / 8), 1e-6);
    EXPECT_NEAR(errors.frame.relative_rmse, errors.frame.rmse, 1e-6);
    EXPECT_NEAR(errors.frame.relative_bias, (2 - 0.2 - 0.4) / 8, 1e-6);
    EXPECT_NEAR(errors.rmse_outside_penumbrae, std::sqrt(0.04 / 4), 1e-6);
    EXPECT_NEAR(errors.rmse_in_penumbrae, std::sqrt((4 + 0.16) / 4), 1e-6);
    EXPECT_TRUE(std::isnan(errors.rmse_blurred));
    ASSERT_EQ(errors.insets.size(), 1u);
    EXPECT_NEAR(errors.insets[0].rmse, std::sqrt((4 + 0.16) / 4), 1e-6);
    EXPECT_NEAR(errors.insets[0].rmse_clamped, std::sqrt(0.16 / 4), 1e-6);
    EXPECT_NEAR(errors.insets[0].relative_rmse, errors.insets[0].rmse / 1.25, 1e-6);
    EXPECT_NEAR(errors.insets[0].relative_bias, (2 - 0.4) / 4 / 1.25, 1e-6);
    EXPECT_EQ(errors.invalid_pixels, 0);
}

TEST(ImageErrors, LeaveOutInvalidPixels) {
    const image::Image reference = row({1, 1, 1, 1});
    const std::vector<bool> outside(4, true);
    ImageErrorSums sums(reference, outside, kInsets);
    sums.add(row({1, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 2}));
    const ImageErrors errors = sums.errors();
    EXPECT_EQ(errors.invalid_pixels, 2);
    EXPECT_NEAR(errors.frame.rmse, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(errors.insets[0].rmse, 1, 1e-6);
}

/// Errors of a square image that are e(x, y), after a blur and without it, over a reference of 1.
template <class Error>
ImageErrors errors_with_blur(const Error& e) {
    constexpr int kSide = 32;
    image::Image reference = image::make_image(kSide, kSide);
    image::Image frame = reference;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            for (int c = 0; c < 3; ++c) {
                const auto i = static_cast<std::size_t>(3 * (y * kSide + x) + c);
                reference.pixels[i] = 1;
                frame.pixels[i] = 1 + static_cast<float>(e(x, y));
            }
    const std::vector<bool> outside(kSide * kSide, true);
    const std::vector<Inset> none;
    ImageErrorSums sums(reference, outside, none, 2);
    sums.add(frame);
    sums.add(frame);
    return sums.errors();
}

TEST(ImageErrors, ABlurLeavesLowFrequenciesOnly) {
    const ImageErrors constant = errors_with_blur([](int, int) { return 0.25; });
    EXPECT_NEAR(constant.frame.rmse, 0.25, 1e-6);
    EXPECT_NEAR(constant.rmse_blurred, 0.25, 1e-6);
    const ImageErrors board = errors_with_blur([](int x, int y) { return (x + y) % 2 == 0 ? 0.25 : -0.25; });
    EXPECT_NEAR(board.frame.rmse, 0.25, 1e-6);
    EXPECT_LT(board.rmse_blurred, 0.01);
    // Rows alone, and columns alone.
    EXPECT_LT(errors_with_blur([](int x, int) { return x % 2 == 0 ? 0.25 : -0.25; }).rmse_blurred, 0.02);
    EXPECT_LT(errors_with_blur([](int, int y) { return y % 2 == 0 ? 0.25 : -0.25; }).rmse_blurred, 0.02);
    // A Gaussian of deviation 2 multiplies waves of 16 pixels by exp(-(2 pi 2 / 16)^2 / 2) = 0.735; the border changes a little.
    const ImageErrors wave = errors_with_blur([](int x, int) { return 0.25 * std::cos(x * 0.392699); });
    EXPECT_NEAR(wave.rmse_blurred / wave.frame.rmse, 0.735, 0.04);
}

} // namespace

} // namespace nusselt::lab
