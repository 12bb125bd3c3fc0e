#include "image/difference.h"
#include "image/flip.h"
#include "image/metrics.h"
#include "image/ssim.h"
#include "image_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nusselt::image::test {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// An image with r = g = b.
Image grey_image(int width, int height, const std::vector<float>& values) {
    Image image{width, height, {}};
    for (const float value : values) image.pixels.insert(image.pixels.end(), 3, value);
    return image;
}

TEST(Metrics, KnownPair) {
    // Differences 1, 0, -1, 2, 0, 0; by hand: squares 1, 0, 1, 4, 0, 0 with references 0, 1, 3, 1, 1, 0.
    const Image a = {2, 1, {1, 1, 2, 3, 1, 0}};
    const Image b = {2, 1, {0, 1, 3, 1, 1, 0}};
    const Comparison comparison = compare(a, b);
    EXPECT_DOUBLE_EQ(comparison.mse, 1.0);
    EXPECT_DOUBLE_EQ(comparison.rmse, 1.0);
    EXPECT_DOUBLE_EQ(comparison.relative_rmse, 1.0);
    EXPECT_DOUBLE_EQ(comparison.rel_mse, (1 / 0.01 + 1 / 9.01 + 4 / 1.01) / 6);
    EXPECT_DOUBLE_EQ(comparison.mae, 4.0 / 6);
    EXPECT_DOUBLE_EQ(comparison.mrse, (2 / 10.01 + 4 / 2.01) / 2);
    EXPECT_DOUBLE_EQ(comparison.mean_a, 8.0 / 6);
    EXPECT_DOUBLE_EQ(comparison.mean_b, 1.0);
    EXPECT_EQ(comparison.compared_pixels, 2);
    EXPECT_EQ(comparison.invalid_a.count, 0);
    EXPECT_EQ(comparison.invalid_b.count, 0);
}

TEST(Metrics, ConstantOffsetAndIdenticalImages) {
    const Comparison offset = compare(grey_image(2, 1, {2.5f, 2.5f}), grey_image(2, 1, {2, 2}));
    EXPECT_DOUBLE_EQ(offset.mse, 0.25);
    EXPECT_DOUBLE_EQ(offset.rmse, 0.5);
    EXPECT_DOUBLE_EQ(offset.relative_rmse, 0.25);
    EXPECT_DOUBLE_EQ(offset.rel_mse, 0.25 / 4.01);
    const Image image = random_image(30, 20, 1);
    const Comparison same = compare(image, image);
    EXPECT_EQ(same.mse, 0);
    EXPECT_EQ(same.rel_mse, 0);
    EXPECT_EQ(same.mean_a, same.mean_b);
}

TEST(Metrics, RandomImagesAgainstMomentsInLongDouble) {
    const Image a = random_image(123, 77, 1);
    const Image b = random_image(123, 77, 2);
    const auto mean = [&](auto term) {
        long double sum = 0;
        for (std::size_t i = a.pixels.size(); i-- > 0;)
            sum += term(static_cast<long double>(a.pixels[i]), static_cast<long double>(b.pixels[i]));
        return double(sum / static_cast<long double>(a.pixels.size()));
    };
    using Real = long double;
    // E[(a - b)^2] = E[a^2] - 2 E[ab] + E[b^2]
    const double mse = mean([](Real x, Real) { return x * x; }) -
                       2 * mean([](Real x, Real y) { return x * y; }) +
                       mean([](Real, Real y) { return y * y; });
    const double mean_b = mean([](Real, Real y) { return y; });
    const Comparison comparison = compare(a, b);
    EXPECT_NEAR(comparison.mse, mse, 1e-12);
    EXPECT_NEAR(comparison.rmse * comparison.rmse, mse, 1e-12);
    EXPECT_NEAR(comparison.relative_rmse, std::sqrt(mse) / mean_b, 1e-12);
    EXPECT_NEAR(comparison.mean_a, mean([](Real x, Real) { return x; }), 1e-12);
    EXPECT_NEAR(comparison.mean_b, mean_b, 1e-12);
    EXPECT_NEAR(comparison.rel_mse,
                mean([](Real x, Real y) { return std::pow(std::hypot(x - y, 0.0L), 2) / (y * y + 0.01L); }),
                1e-11);
    EXPECT_NEAR(comparison.mae, mean([](Real x, Real y) { return std::max(x, y) - std::min(x, y); }), 1e-12);
    Real mrse = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
        const float* p = &a.pixels[i];
        const float* q = &b.pixels[i];
        const Real distance = std::hypot(Real(p[0]) - q[0], Real(p[1]) - q[1], Real(p[2]) - q[2]);
        mrse += distance * distance / (std::pow(std::hypot(Real(q[0]), Real(q[1]), Real(q[2])), 2) + 0.01L);
    }
    EXPECT_NEAR(comparison.mrse, double(3 * mrse / Real(a.pixels.size())), 1e-11);
}

TEST(Metrics, DarkPixelsDifferRelativeToTheMean) {
    const Image reference{2, 1, {1, 1, 1, 1e-3f, 1e-3f, 1e-3f}};
    const auto share = [&](float bright, float dark) {
        return differing_share({2, 1, {bright, 1, 1, 1e-3f, dark, 1e-3f}}, reference, 0.1, 0.01);
    };
    EXPECT_EQ(share(1.09f, 1.4e-3f), 0) << "a tenth of a hundredth of the mean is 5e-4";
    EXPECT_EQ(share(1.11f, 1.4e-3f), 0.5);
    EXPECT_EQ(share(1.09f, 1.6e-3f), 0.5);
    EXPECT_EQ(share(NAN, NAN), 1);
    EXPECT_EQ(differing_share({2, 1, {1, 1, 1, 1e-3f, 1.2e-3f, 1e-3f}}, reference, 0.1, 0), 0.5);
}

TEST(Metrics, NothingAgreesWithAReferenceThatIsNotFinite) {
    const Image finite{1, 1, {1, 1, 1}};
    for (const float value : {INFINITY, NAN}) {
        const Image reference{1, 1, {1, 1, value}};
        EXPECT_EQ(differing_share(finite, reference, 0.1, 0), 1);
        EXPECT_EQ(differing_share(reference, reference, 0.1, 0), 1);
    }
}

TEST(Metrics, OfBlackImagesAreNumbers) {
    const Image black = make_image(3, 3);
    const Comparison same = compare(black, black);
    EXPECT_EQ(same.relative_rmse, 0);
    EXPECT_EQ(same.mrse, 0);
    EXPECT_EQ(compare(grey_image(3, 3, std::vector<float>(9, 1)), black).relative_rmse,
              std::numeric_limits<double>::infinity());
}

TEST(Metrics, HueOfTheReferenceMattersToRelMseOnly) {
    // The same error along red: relMSE divides it by the dark red of a green pixel, MRSE by the whole pixel.
    const Image red = {1, 1, {1, 0, 0}};
    const Image green = {1, 1, {0, 1, 0}};
    const Comparison on_red = compare({1, 1, {1.5f, 0, 0}}, red);
    const Comparison on_green = compare({1, 1, {0.5f, 1, 0}}, green);
    EXPECT_DOUBLE_EQ(on_red.mrse, 0.25 / 1.01);
    EXPECT_DOUBLE_EQ(on_green.mrse, on_red.mrse);
    EXPECT_DOUBLE_EQ(on_green.rel_mse, 0.25 / 0.01 / 3);
    EXPECT_DOUBLE_EQ(on_red.rel_mse, 0.25 / 1.01 / 3);
}

TEST(Metrics, SumsAreDouble) {
    // In float, the squares overflow and the sum of 25 million values stalls.
    const Comparison large = compare(grey_image(2, 1, {2e30f, 2e30f}), grey_image(2, 1, {1e30f, 1e30f}));
    EXPECT_NEAR(large.rmse / 1e30, 1, 1e-6);
    const Image a = grey_image(4096, 2048, std::vector<float>(4096 * 2048, 1.1f));
    EXPECT_NEAR(compare(a, a).mean_a, double(1.1f), 1e-9);
}

TEST(Metrics, InvalidPixelsAreCountedLocatedAndLeftOut) {
    Image a = random_image(10, 6, 1);
    Image b = random_image(10, 6, 2);
    Image valid_a = a;
    Image valid_b = b;
    a.pixels[3 * 25 + 1] = kNan;      // x 5 y 2
    a.pixels[3 * 30 + 2] = kInfinity; // x 0 y 3
    a.pixels[3 * 30 + 0] = kNan;      // again, a pixel with both
    b.pixels[3 * 25 + 0] = -kInfinity;
    b.pixels[3 * 59 + 2] = -kInfinity; // x 9 y 5
    const Comparison comparison = compare(a, b);
    EXPECT_EQ(comparison.invalid_a.count, 2);
    EXPECT_EQ(comparison.invalid_a.nan_count, 2);
    EXPECT_EQ(comparison.invalid_b.count, 2);
    EXPECT_EQ(comparison.invalid_b.nan_count, 0);
    ASSERT_EQ(comparison.invalid_a.first.size(), 2u);
    EXPECT_EQ(comparison.invalid_a.first[0].x, 5);
    EXPECT_EQ(comparison.invalid_a.first[0].y, 2);
    EXPECT_EQ(comparison.invalid_a.first[1].x, 0);
    EXPECT_EQ(comparison.invalid_a.first[1].y, 3);
    EXPECT_EQ(comparison.invalid_a.first[1].rgb[2], kInfinity);
    ASSERT_EQ(comparison.invalid_b.first.size(), 2u);
    EXPECT_EQ(comparison.invalid_b.first[1].x, 9);
    EXPECT_EQ(comparison.invalid_b.first[1].y, 5);
    EXPECT_EQ(comparison.compared_pixels, 57);

    for (const std::size_t pixel : {59u, 30u, 25u}) {
        for (Image* image : {&valid_a, &valid_b}) {
            const auto begin = image->pixels.begin() + std::ptrdiff_t(3 * pixel);
            image->pixels.erase(begin, begin + 3);
        }
    }
    valid_a.width = valid_b.width = 57;
    valid_a.height = valid_b.height = 1;
    const Comparison valid = compare(valid_a, valid_b);
    EXPECT_EQ(comparison.mse, valid.mse);
    EXPECT_EQ(comparison.rel_mse, valid.rel_mse);
    EXPECT_EQ(comparison.mean_a, valid.mean_a);
    EXPECT_EQ(comparison.mean_b, valid.mean_b);
}

TEST(Metrics, OnlyInvalidPixels) {
    const Image a = grey_image(5, 5, std::vector<float>(25, kNan));
    const Comparison comparison = compare(a, grey_image(5, 5, std::vector<float>(25, 1)));
    EXPECT_EQ(comparison.invalid_a.count, 25);
    EXPECT_EQ(comparison.invalid_a.first.size(), 10u);
    EXPECT_EQ(comparison.compared_pixels, 0);
    EXPECT_TRUE(std::isnan(comparison.mse));
    EXPECT_TRUE(std::isnan(comparison.mean_b));
    EXPECT_TRUE(std::isnan(comparison.mrse));
    EXPECT_TRUE(std::isnan(comparison.relative_rmse));
    EXPECT_FALSE(std::signbit(comparison.mse)) << "printed as -nan";
}

TEST(Metrics, DifferentSizesAreBothNamed) {
    const Image a = random_image(4, 3, 1);
    const Image b = random_image(3, 4, 1);
    for (const std::string& error :
         {error_of([&] { (void)compare(a, b); }), error_of([&] { (void)difference_scale(a, b); }),
          error_of([&] { (void)signed_difference_image(a, b, 1); }),
          error_of([&] { (void)absolute_difference_image(a, b, 1); }), error_of([&] { (void)psnr(a, b); }),
          error_of([&] { (void)ssim(a, b); }), error_of([&] { (void)flip(a, b); }),
          error_of([&] { (void)hdr_flip(a, b, {}); })}) {
        EXPECT_NE(error.find("4 x 3"), std::string::npos) << error;
        EXPECT_NE(error.find("3 x 4"), std::string::npos) << error;
    }
}

TEST(DifferenceScale, IsThe99thPercentile) {
    // |differences| 1 to 1000 in some order, with both signs and in different channels.
    Image a = make_image(100, 10);
    const Image b = make_image(100, 10);
    for (std::size_t i = 0; i < 1000; ++i) {
        const std::size_t shuffled = i * 37 % 1000;
        a.pixels[3 * i + i % 3] = float(shuffled + 1) * (i % 2 == 0 ? 1.0f : -1.0f);
        a.pixels[3 * i + (i + 1) % 3] = 0.5f;
    }
    EXPECT_NEAR(difference_scale(a, b), 990, 1);
}

TEST(DifferenceScale, FallsBackToTheLargestThenToOne) {
    Image a = make_image(100, 10);
    const Image b = make_image(100, 10);
    EXPECT_EQ(difference_scale(a, b), 1);
    a.pixels[777] = -0.125f;
    EXPECT_EQ(difference_scale(a, b), 0.125);
    a.pixels[777] = kNan;
    EXPECT_EQ(difference_scale(a, b), 1);
}

/// The colours for grey differences t = -1, ..., 1 at scale 1.
std::vector<std::array<double, 3>> color_scale() {
    const Image a = grey_image(5, 1, {-1, -0.5f, 0, 0.5f, 1});
    const Image colors = signed_difference_image(a, make_image(5, 1), 1);
    std::vector<std::array<double, 3>> result;
    for (std::size_t i = 0; i < 15; i += 3)
        result.push_back({colors.pixels[i], colors.pixels[i + 1], colors.pixels[i + 2]});
    return result;
}

TEST(SignedDifference, BlueWhiteRed) {
    const auto colors = color_scale();
    for (const std::size_t negative : {0u, 1u}) EXPECT_GT(colors[negative][2], 1.2 * colors[negative][0]);
    for (const std::size_t positive : {3u, 4u}) EXPECT_GT(colors[positive][0], 1.2 * colors[positive][2]);
    for (const double channel : colors[2]) EXPECT_NEAR(channel, 1, 1e-6);
    for (const auto& color : colors) {
        for (const double channel : color) {
            EXPECT_GE(channel, 0);
            EXPECT_LE(channel, 1 + 1e-6);
        }
    }
}

TEST(SignedDifference, EqualErrorsAreEquallyLight) {
    // Lightness L* of CIELAB, another colour space than the one that made the colours.
    const auto lightness = [](const std::array<double, 3>& rgb) {
        return 116 * std::cbrt(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) - 16;
    };
    const auto colors = color_scale();
    EXPECT_NEAR(lightness(colors[0]), lightness(colors[4]), 6);
    EXPECT_NEAR(lightness(colors[1]), lightness(colors[3]), 6);
    EXPECT_LT(lightness(colors[0]), lightness(colors[1]) - 20);
    EXPECT_LT(lightness(colors[1]), lightness(colors[2]) - 20);
}

TEST(SignedDifference, ScaleSaturatesAndTheLargestChannelDecides) {
    const Image zero = make_image(1, 1);
    const auto color = [&](std::vector<float> rgb, double scale) {
        return signed_difference_image(Image{1, 1, std::move(rgb)}, zero, scale).pixels;
    };
    EXPECT_EQ(color({5, 5, 5}, 1), color({1, 1, 1}, 1));
    EXPECT_EQ(color({-5, -5, -5}, 1), color({-1, -1, -1}, 1));
    EXPECT_EQ(color({0.5f, 0.5f, 0.5f}, 2), color({0.25f, 0.25f, 0.25f}, 1));
    EXPECT_EQ(color({0.25f, -0.5f, 0.25f}, 1), color({-0.5f, -0.5f, -0.5f}, 1));
    EXPECT_NE(color({0.5f, 0.5f, 0.5f}, 1), color({0.25f, 0.25f, 0.25f}, 1));
    for (const float bad : {kNan, kInfinity, -kInfinity})
        EXPECT_EQ(color({0, bad, 0}, 1), (std::vector<float>{0, 0, 0}));
}

TEST(AbsoluteDifference, KnownPair) {
    const Image a = {2, 1, {1, -1, 0.5f, kNan, 1, 1}};
    const Image b = {2, 1, {0, 3, 0.5f, 0, 0, 0}};
    EXPECT_EQ(absolute_difference_image(a, b, 2).pixels, (std::vector<float>{0.5f, 2, 0, 0, 0, 0}));
}

TEST(ErrorMap, GetsLighterFromBlackToYellowWithoutClipping) {
    Plane map = make_plane(1001, 1);
    for (std::size_t i = 0; i <= 1000; ++i) map.values[i] = double(i) / 1000;
    const Image colors = error_map_image(map);
    double last = -1;
    for (std::size_t i = 0; i < colors.pixels.size(); i += 3) {
        const float* rgb = &colors.pixels[i];
        for (int c = 0; c < 3; ++c) {
            ASSERT_GE(rgb[c], -1e-7f) << i;
            ASSERT_LE(rgb[c], 1) << i;
        }
        const double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        ASSERT_GT(luminance, last) << i;
        last = luminance;
    }
    const auto at = [&](double t) { return &colors.pixels[3 * std::size_t(1000 * t)]; };
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(0)[c], 0, 1e-7);
    EXPECT_GT(at(0.2)[2], at(0.2)[0]) << "purple";
    EXPECT_GT(at(0.6)[0], 2 * at(0.6)[2]) << "red";
    EXPECT_GT(last, 0.85);
}

} // namespace

} // namespace nusselt::image::test
