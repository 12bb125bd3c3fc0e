#include "image/flip.h"
#include "image/metrics.h"
#include "image_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace nusselt::image::test {

namespace {

using Rgb = std::array<double, 3>;
using Channel = std::vector<std::vector<double>>; // [y][x]

constexpr double kPi = 3.14159265358979323846;

Rgb multiply(const double (&m)[3][3], const Rgb& v) {
    Rgb result;
    for (int i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

/// The formulas of both papers once more, from the published constants (decimal matrices and white point), with
/// two-dimensional filters instead of separable ones.
class NaiveFlip {
public:
    NaiveFlip(int width, int height, double pixels_per_degree)
        : width_(width), height_(height), ppd_(pixels_per_degree) {}

    /// \param a, b  values on the display, linear, in [0, 1]
    double at(const std::function<Rgb(int, int)>& a, const std::function<Rgb(int, int)>& b, int x,
              int y) const {
        const Rgb lab_a = seen(a, x, y);
        const Rgb lab_b = seen(b, x, y);
        const double hyab = std::abs(lab_a[0] - lab_b[0]) +
                            std::sqrt(std::pow(lab_a[1] - lab_b[1], 2) + std::pow(lab_a[2] - lab_b[2], 2));
        const double color = redistribute(std::pow(hyab, 0.7));
        const double edges = std::abs(feature(a, x, y, edge_kernel) - feature(b, x, y, edge_kernel));
        const double points = std::abs(feature(a, x, y, point_kernel) - feature(b, x, y, point_kernel));
        return std::pow(color, 1 - std::sqrt(std::max(edges, points) / std::sqrt(2)));
    }

    static double redistribute(double error) {
        const Rgb green = hunt_lab({0, 1, 0});
        const Rgb blue = hunt_lab({0, 0, 1});
        const double cmax =
            std::pow(std::abs(green[0] - blue[0]) +
                         std::sqrt(std::pow(green[1] - blue[1], 2) + std::pow(green[2] - blue[2], 2)),
                     0.7);
        return error < 0.4 * cmax ? error * 0.95 / (0.4 * cmax)
                                  : 0.95 + 0.05 * (error - 0.4 * cmax) / (0.6 * cmax);
    }

    static Rgb hunt_lab(const Rgb& rgb) {
        const Rgb xyz = to_xyz(rgb);
        const auto f = [](double t) {
            return t > 216.0 / 24389 ? std::pow(t, 1.0 / 3) : t * 841 / 108 + 4.0 / 29;
        };
        const double l = 116 * f(xyz[1]) - 16;
        return {l, l / 100 * 500 * (f(xyz[0] / 0.950428545) - f(xyz[1])),
                l / 100 * 200 * (f(xyz[1]) - f(xyz[2] / 1.088900371))};
    }

private:
    static Rgb to_xyz(const Rgb& rgb) {
        constexpr double m[3][3] = {{0.412386564, 0.357591485, 0.180450487},
                                    {0.212636839, 0.715182971, 0.072180183},
                                    {0.019330620, 0.119197162, 0.950372569}};
        return multiply(m, rgb);
    }
    static Rgb to_rgb(const Rgb& xyz) {
        constexpr double m[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                    {-0.969224334, 1.875930071, 0.041554224},
                                    {0.055639423, -0.204011202, 1.057148933}};
        return multiply(m, xyz);
    }
    static Rgb to_ycxcz(const Rgb& rgb) {
        const Rgb xyz = to_xyz(rgb);
        const double x = xyz[0] / 0.950428545, z = xyz[2] / 1.088900371;
        return {116 * xyz[1] - 16, 500 * (x - xyz[1]), 200 * (xyz[1] - z)};
    }

    Rgb pixel(const std::function<Rgb(int, int)>& image, int x, int y) const {
        return to_ycxcz(image(std::min(std::max(x, 0), width_ - 1), std::min(std::max(y, 0), height_ - 1)));
    }

    Rgb seen(const std::function<Rgb(int, int)>& image, int x, int y) const {
        const int r = int(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd_));
        Rgb sum = {}, weights = {};
        for (int j = -r; j <= r; ++j) {
            for (int i = -r; i <= r; ++i) {
                const double d2 = (i * i + j * j) / (ppd_ * ppd_);
                const auto gaussian = [&](double a, double b) {
                    return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * d2 / b);
                };
                const Rgb w = {gaussian(1, 0.0047), gaussian(1, 0.0053),
                               gaussian(34.1, 0.04) + gaussian(13.5, 0.025)};
                const Rgb value = pixel(image, x + i, y + j);
                for (int c = 0; c < 3; ++c) sum[c] += w[c] * value[c], weights[c] += w[c];
            }
        }
        for (int c = 0; c < 3; ++c) sum[c] /= weights[c];
        const double luminance = (sum[0] + 16) / 116;
        Rgb rgb = to_rgb(
            {(luminance + sum[1] / 500) * 0.950428545, luminance, (luminance - sum[2] / 200) * 1.088900371});
        for (double& value : rgb) value = std::min(std::max(value, 0.0), 1.0);
        return hunt_lab(rgb);
    }

    static double edge_kernel(double x, double y, double s) {
        return -x * std::exp(-(x * x + y * y) / (2 * s * s));
    }
    static double point_kernel(double x, double y, double s) {
        return (x * x / (s * s) - 1) * std::exp(-(x * x + y * y) / (2 * s * s));
    }

    double feature(const std::function<Rgb(int, int)>& image, int x, int y,
                   double (*kernel)(double, double, double)) const {
        const double s = 0.5 * 0.082 * ppd_;
        const int r = int(std::ceil(3 * s));
        double positive = 0, negative = 0;
        for (int j = -r; j <= r; ++j)
            for (int i = -r; i <= r; ++i) (kernel(i, j, s) > 0 ? positive : negative) += kernel(i, j, s);
        double along_x = 0, along_y = 0;
        for (int j = -r; j <= r; ++j) {
            for (int i = -r; i <= r; ++i) {
                const double brightness = (pixel(image, x + i, y + j)[0] + 16) / 116;
                const auto weight = [&](double k) { return k > 0 ? k / positive : -k / negative; };
                along_x += weight(kernel(i, j, s)) * brightness;
                along_y += weight(kernel(j, i, s)) * brightness;
            }
        }
        return std::sqrt(along_x * along_x + along_y * along_y);
    }

    int width_, height_;
    double ppd_;
};

Rgb linear_pixel(const Image& image, int x, int y) {
    const float* rgb = &image.pixels[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
    return {rgb[0], rgb[1], rgb[2]};
}

Image constant_image(int width, int height, const Rgb& rgb) {
    Image image = make_image(width, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(rgb[i % 3]);
    return image;
}

/// The curve of Narkowicz as he published it, with his exposure of 0.6.
double aces(double exposed) {
    const double x = 0.6 * exposed;
    return std::min(std::max(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0), 1.0);
}

double inverse_aces(double y) {
    double low = 0, high = 100;
    for (int i = 0; i < 200; ++i) (aces((low + high) / 2) < y ? low : high) = (low + high) / 2;
    return low;
}

/// Noise, an edge, a saturated corner, values above 1 and below 0.
Image test_image(int width, int height, unsigned seed) {
    Image image = random_image(width, height, seed);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const int x = int(i / 3) % width;
        if (x > width / 2) image.pixels[i] *= 0.1f;
        if (x < width / 4 && i % 3 == 2) image.pixels[i] = -0.5f;
    }
    return image;
}

TEST(Flip, IsItsDefinition) {
    const Image a = test_image(23, 17, 1);
    const Image b = test_image(23, 17, 2);
    for (const double ppd : {67.0206432765823, 20.0, 3.0}) {
        for (const double exposure : {0.0, -2.5}) {
            const Plane map = flip(a, b, ppd, exposure);
            const auto displayed = [&](const Image& image) {
                return [&image, exposure](int x, int y) {
                    Rgb rgb = linear_pixel(image, x, y);
                    for (double& value : rgb)
                        value = std::min(std::max(value * std::pow(2, exposure), 0.0), 1.0);
                    return rgb;
                };
            };
            const NaiveFlip naive(23, 17, ppd);
            for (const auto& [x, y] : {std::pair{0, 0}, {22, 16}, {11, 8}, {12, 3}, {5, 16}, {20, 9}})
                EXPECT_NEAR(map.row(y)[x], naive.at(displayed(a), displayed(b), x, y), 1e-6)
                    << x << " " << y << " at " << ppd;
        }
    }
}

TEST(Flip, DefaultIsAScreenOfTheFourThousandsAtItsOwnWidth) {
    EXPECT_NEAR(kFlipPixelsPerDegree, 0.7 * 3840 / 0.7 * kPi / 180, 1e-12);
}

TEST(Flip, OfConstantImages) {
    // Green against blue is the largest error by definition; without edges the colours alone count.
    const auto error = [](const Rgb& a, const Rgb& b) {
        const Plane map = flip(constant_image(9, 5, a), constant_image(9, 5, b));
        for (const double value : map.values) EXPECT_NEAR(value, map.values[0], 1e-9);
        return map.values[0];
    };
    EXPECT_NEAR(error({0, 1, 0}, {0, 0, 1}), 1, 1e-9);
    EXPECT_NEAR(error({0, 0, 1}, {0, 1, 0}), 1, 1e-9);
    // Black against white is a distance of 100 along L* alone.
    EXPECT_NEAR(error({0, 0, 0}, {1, 1, 1}), NaiveFlip::redistribute(std::pow(100, 0.7)), 1e-7);
    // Greys of L* 50 and 51 are a distance of 1: below the knee.
    const auto grey = [](double l) { return std::pow((l + 16) / 116, 3); };
    const Rgb g50 = {grey(50), grey(50), grey(50)}, g51 = {grey(51), grey(51), grey(51)};
    EXPECT_NEAR(error(g50, g51), NaiveFlip::redistribute(1), 1e-6);
}

TEST(Flip, EqualImagesHaveNoneAndOrderDoesNotMatter) {
    const Image a = test_image(30, 20, 1);
    const Image b = test_image(30, 20, 2);
    for (const double value : flip(a, a).values) ASSERT_EQ(value, 0);
    const Plane ab = flip(a, b);
    const Plane ba = flip(b, a);
    for (std::size_t i = 0; i < ab.values.size(); ++i) {
        ASSERT_NEAR(ab.values[i], ba.values[i], 1e-12);
        ASSERT_GT(ab.values[i], 0);
        ASSERT_LE(ab.values[i], 1);
    }
    EXPECT_GT(mean_of_valid(ab, a, b), mean_of_valid(flip(a, a), a, a));
}

TEST(Flip, InvalidPixelsAreBlackInBothAndLeftOut) {
    Image a = test_image(30, 20, 1);
    const Image b = test_image(30, 20, 2);
    Image black_a = a, black_b = b;
    for (const std::size_t pixel : {17u, 333u}) {
        a.pixels[3 * pixel + 1] =
            pixel == 17 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
        for (std::size_t c = 0; c < 3; ++c) black_a.pixels[3 * pixel + c] = black_b.pixels[3 * pixel + c] = 0;
    }
    const Plane map = flip(a, b);
    EXPECT_EQ(map.values, flip(black_a, black_b).values);
    double sum = 0;
    for (std::size_t i = 0; i < map.values.size(); ++i) sum += i == 17 || i == 333 ? 0 : map.values[i];
    EXPECT_NEAR(mean_of_valid(map, a, b), sum / 598, 1e-12);
    EXPECT_TRUE(std::isnan(mean_of_valid(make_plane(1, 1), {1, 1, {0, 0, std::nanf("")}}, make_image(1, 1))));
}

/// The test of the authors' implementation expects -12.5423 to 0.9427 in 14 steps for its pair of images; here
/// is a reference with the same brightest and median luminance.
TEST(HdrFlip, ExposuresOfThePaper) {
    const double bright = inverse_aces(0.85);
    Image reference = make_image(5, 1);
    const std::array<double, 5> luminances = {0, 0.5 * bright * std::exp2(-0.9427),
                                              bright * std::exp2(-0.9427), 9, bright * std::exp2(12.5423)};
    for (std::size_t i = 0; i < 15; ++i) reference.pixels[i] = float(luminances[i / 3]);
    const FlipExposures exposures = flip_exposures(reference);
    EXPECT_NEAR(exposures.first, -12.5423, 1e-6);
    EXPECT_NEAR(exposures.last, 0.9427, 1e-6);
    EXPECT_EQ(exposures.count, 14);
}

TEST(HdrFlip, ExposuresOfHostileReferences) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(flip_exposures({1, 1, {kNan, 0, 0}}).count, 2);
    for (const float value : {0.0f, -1.0f, 1e-40f, 1e38f}) {
        const FlipExposures exposures = flip_exposures(constant_image(2, 2, {value, value, value}));
        EXPECT_TRUE(std::isfinite(exposures.first)) << value;
        EXPECT_EQ(exposures.first, exposures.last);
    }
    const FlipExposures widest = flip_exposures({3, 1, {0, 0, 0, 0, 0, 0, 1e38f, 1e38f, 1e38f}});
    EXPECT_EQ(widest.count, 40) << "from 2^-24 to 2^16";
    // The median of an even number of pixels is between the two in the middle.
    const FlipExposures even = flip_exposures({2, 1, {1, 1, 1, 3, 3, 3}});
    EXPECT_NEAR(even.last - even.first, std::log2(1.5), 1e-9);
}

TEST(HdrFlip, IsTheLargestOverTheExposures) {
    Image a = test_image(21, 15, 1);
    Image b = test_image(21, 15, 2);
    for (float& value : a.pixels) value *= 40;
    for (float& value : b.pixels) value *= 40;
    const FlipExposures exposures = flip_exposures(b);
    ASSERT_GT(exposures.count, 2);
    const Plane map = hdr_flip(a, b, exposures);
    const NaiveFlip naive(21, 15, kFlipPixelsPerDegree);
    for (const auto& [x, y] : {std::pair{0, 0}, {20, 14}, {10, 7}, {3, 9}}) {
        double largest = 0;
        for (int i = 0; i < exposures.count; ++i) {
            const double exposure =
                exposures.first + (exposures.last - exposures.first) * i / (exposures.count - 1);
            const auto displayed = [exposure](const Image& image) {
                return [&image, exposure](int u, int v) {
                    Rgb rgb = linear_pixel(image, u, v);
                    for (double& value : rgb) value = aces(std::exp2(exposure) * std::max(value, 0.0));
                    return rgb;
                };
            };
            largest = std::max(largest, naive.at(displayed(a), displayed(b), x, y));
        }
        EXPECT_NEAR(map.row(y)[x], largest, 1e-6) << x << " " << y;
    }
    for (const double value : hdr_flip(a, a, flip_exposures(a)).values) ASSERT_EQ(value, 0);
}

TEST(HdrFlip, SeesErrorsThatTheDisplayClips) {
    const Image reference = constant_image(4, 4, {8, 8, 8});
    const Image brighter = constant_image(4, 4, {16, 16, 16});
    EXPECT_EQ(flip(brighter, reference).values[0], 0) << "both are white";
    const double white = inverse_aces(0.85);
    const auto lightness = [](double y) { return 116 * std::cbrt(y) - 16; };
    const double distance = lightness(aces(2 * white)) - lightness(0.85);
    EXPECT_NEAR(hdr_flip(brighter, reference, flip_exposures(reference)).values[0],
                NaiveFlip::redistribute(std::pow(distance, 0.7)), 1e-6);
}

} // namespace

} // namespace nusselt::image::test
