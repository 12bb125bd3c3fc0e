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

} // namespace

} // namespace nusselt::lab
