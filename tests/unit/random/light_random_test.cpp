/// Tests of the random numbers of a renderer: uniform over pixels, stratified in each pixel, independent wherever
/// they should be, and the same in lanes.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/random/light_random.h>
#include <nusselt/random/sobol.h>

#include "random_statistics.h"
#include "shipped_blue_noise.h"

namespace {

using nusselt::camera_random;
using nusselt::camera_random_lanes;
using nusselt::light_random_lanes;
using nusselt::owen_scrambled_sobol;
using nusselt::pcg4d;
using nusselt::Sampler;
using nusselt::to_unit;
using nusselt::UInt4;
using nusselt::Vec2;
using nusselt::test::CellCounts;
using nusselt::test::shipped_blue_noise;
using nusselt::test::sidak_level;

constexpr Sampler kSamplers[] = {Sampler::independent, Sampler::sobol,   Sampler::jittered,
                                 Sampler::stratified,  Sampler::z_sobol, Sampler::blue_noise};
constexpr int kSamplerCount = static_cast<int>(std::size(kSamplers));
constexpr std::uint32_t kWidth = 256;
constexpr std::uint32_t kSamples = 16;

struct Pixel {
    std::uint32_t x, y;
};

/// With the blue noise that ships.
template <class Scalar = float>
Vec2<Scalar> random_numbers(Sampler kind, std::uint32_t seed, std::uint32_t x, std::uint32_t y,
                            std::uint32_t sample, std::uint32_t sample_count, std::uint32_t light,
                            std::uint32_t pair = 0) {
    return nusselt::light_random<Scalar>(kind, seed, x, y, sample, sample_count, light, pair,
                                         shipped_blue_noise());
}

/// A seed for tests over the pixels of an image. Blue noise is the same in all tiles, so each of them has another seed.
std::uint32_t seed_at(Sampler kind, std::uint32_t seed, Pixel p) {
    return kind == Sampler::blue_noise ? seed + 1000 * (p.x / 64) + 100000 * (p.y / 64) : seed;
}

/// Whether x of sample k is in the stratum of that number.
bool has_ordered_strata(Sampler kind) { return kind == Sampler::jittered || kind == Sampler::blue_noise; }

/// p-value of the hypothesis that a function of the pixel is uniform on the unit square, over the pixels of an image.
double p_value_over_pixels(const std::function<Vec2<double>(Pixel)>& f) {
    CellCounts counts;
    for (std::uint32_t y = 0; y < kWidth; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const Vec2<double> u = f({x, y});
            counts.add(u.x, u.y);
        }
    }
    return counts.p_value();
}

/// A sample of light 3, with the stratum of jittered samples stretched to the unit interval.
Vec2<double> stretched(Sampler kind, Pixel p, std::uint32_t sample) {
    Vec2<double> u = random_numbers<double>(kind, seed_at(kind, 11, p), p.x, p.y, sample, kSamples, 3);
    if (has_ordered_strata(kind)) u.x = u.x * kSamples - sample;
    return u;
}

TEST(LightRandom, EachSampleIsUniformOverPixels) {
    constexpr std::uint32_t kChecked[] = {0, 1, 2, 7, 15};
    const double level = sidak_level(kSamplerCount * 5);
    for (const Sampler kind : kSamplers)
        for (const std::uint32_t sample : kChecked)
            EXPECT_GT(p_value_over_pixels([&](Pixel p) { return stretched(kind, p, sample); }), level)
                << static_cast<int>(kind) << " sample " << sample;
}

TEST(LightRandom, TestOfUniformityRejectsBias) {
    const double level = sidak_level(kSamplerCount * 5);
    for (const Sampler kind : kSamplers) {
        // Mutant: the last 64th of the interval is missing.
        EXPECT_LT(p_value_over_pixels([&](Pixel p) {
                      const Vec2<double> u = stretched(kind, p, 1);
                      return Vec2<double>{u.x * (63.0 / 64), u.y};
                  }),
                  level);
        // Mutant: the numbers are denser near 0.
        EXPECT_LT(p_value_over_pixels([&](Pixel p) {
                      const Vec2<double> u = stretched(kind, p, 1);
                      return Vec2<double>{u.x, u.y * u.y};
                  }),
                  level);
    }
}

TEST(CameraRandom, IsUniformOverPixels) {
    for (const Sampler kind : kSamplers)
        EXPECT_GT(p_value_over_pixels([&](Pixel p) { return camera_random<double>(kind, 5, p.x, p.y, 3); }),
                  sidak_level(kSamplerCount));
}

/// A pair of numbers, as a function of the pixel, that must be independent of each other.
struct NamedPair {
    const char* name;
    std::function<Vec2<double>(Sampler, Pixel)> numbers;
    bool of_neighbours = false;
};

bool makes_neighbours_differ(Sampler kind) { return kind == Sampler::z_sobol || kind == Sampler::blue_noise; }

double x_of(Sampler kind, std::uint32_t seed, Pixel p, std::uint32_t light, std::uint32_t pair = 0) {
    const double u =
        random_numbers<double>(kind, seed_at(kind, seed, p), p.x, p.y, 5, kSamples, light, pair).x;
    return has_ordered_strata(kind) ? u * kSamples - 5 : u;
}

const std::vector<NamedPair>& independent_pairs() {
    static const std::vector<NamedPair> pairs{
        {"lights",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 0), x_of(s, 1, p, 1)};
         }},
        {"far lights",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 2), x_of(s, 1, p, 65538)};
         }},
        {"pixels in a row",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 0), x_of(s, 1, {p.x + 1, p.y}, 0)};
         },
         true},
        {"pixels in a column",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 0), x_of(s, 1, {p.x, p.y + 1}, 0)};
         },
         true},
        {"transposed pixels",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 0), x_of(s, 1, {p.y + 1000, p.x}, 0)};
         }},
        {"seeds",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 0), x_of(s, 2, p, 0)};
         }},
        {"seed and light",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 2), x_of(s, 2, p, 1)};
         }},
        {"pairs of dimensions",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 0, 0), x_of(s, 1, p, 0, 1)};
         }},
        {"light and pair",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 1, 0), x_of(s, 1, p, 0, 1)};
         }},
        {"camera and light",
         [](Sampler s, Pixel p) {
             return Vec2<double>{x_of(s, 1, p, 0), camera_random<double>(s, 1, p.x, p.y, 5).x};
         }},
    };
    return pairs;
}

TEST(LightRandom, NumbersAreIndependentOverPixels) {
    const double level = sidak_level(kSamplerCount * static_cast<int>(independent_pairs().size()));
    for (const NamedPair& pair : independent_pairs())
        for (const Sampler kind : kSamplers)
            if (!(pair.of_neighbours && makes_neighbours_differ(kind))) {
                EXPECT_GT(p_value_over_pixels([&](Pixel p) { return pair.numbers(kind, p); }), level)
                    << pair.name << ", sampler " << static_cast<int>(kind);
            }
}

/// Neighbours have numbers that others leave out, which the test of independence notices.
TEST(LightRandom, NeighboursDiffer) {
    const auto mean_distance = [](Sampler kind) {
        double sum = 0;
        for (std::uint32_t y = 0; y < 64; ++y)
            for (std::uint32_t x = 0; x < 64; ++x)
                sum += std::fabs(random_numbers<double>(kind, 1, 2 * x, y, 0, 1, 0).x -
                                 random_numbers<double>(kind, 1, 2 * x + 1, y, 0, 1, 0).x);
        return sum / 4096;
    };
    // Independent numbers have a mean distance of 1/3, with a standard deviation of 0.0037. With one pixel of a square in
    // each quarter, it is 5/12.
    EXPECT_NEAR(mean_distance(Sampler::sobol), 1.0 / 3, 0.015);
    EXPECT_NEAR(mean_distance(Sampler::z_sobol), 5.0 / 12, 0.015);
    EXPECT_GT(mean_distance(Sampler::blue_noise), 0.4);
}

TEST(LightRandom, EachPixelIsUniformOverSeeds) {
    const double level = sidak_level(kSamplerCount * 2);
    const auto p_value = [](const std::function<Vec2<double>(std::uint32_t)>& f) {
        CellCounts counts;
        for (std::uint32_t seed = 0; seed < kWidth * kWidth; ++seed) {
            const Vec2<double> u = f(seed);
            counts.add(u.x, u.y);
        }
        return counts.p_value();
    };
    for (const Sampler kind : kSamplers)
        for (const Pixel p : {Pixel{0, 0}, Pixel{77, 1234}})
            EXPECT_GT(p_value([&](std::uint32_t seed) {
                          return random_numbers<double>(kind, seed, p.x, p.y, 0, 1, 5);
                      }),
                      level)
                << static_cast<int>(kind);
    // Mutants: blue noise that has the same shift for all seeds, and one that has the same shift for x and y.
    const auto number = [](std::uint32_t index, std::uint32_t low) {
        return to_unit<double>(nusselt::blue_noise_bits(shipped_blue_noise().rank(index), low));
    };
    EXPECT_LT(p_value([&](std::uint32_t seed) {
                  const UInt4 key = pcg4d({seed, 1, 0, 0});
                  return Vec2<double>{number(7, key.x), number(4096 + 7, key.y)};
              }),
              level);
    EXPECT_LT(p_value([&](std::uint32_t seed) {
                  const UInt4 key = pcg4d({seed, 1, 0, 0});
                  return Vec2<double>{number(key.z >> 20, key.x), number(4096 + (key.z >> 20), key.y)};
              }),
              level);
}

TEST(LightRandom, TestOfIndependenceRejectsReuse) {
    for (const Sampler kind : kSamplers) {
        // Mutants: two lights use the same numbers, once with a shift.
        EXPECT_LT(p_value_over_pixels([&](Pixel p) {
                      return Vec2<double>{x_of(kind, 1, p, 0), x_of(kind, 1, p, 0)};
                  }),
                  sidak_level(30));
        EXPECT_LT(p_value_over_pixels([&](Pixel p) {
                      const double u = x_of(kind, 1, p, 0);
                      return Vec2<double>{u, u < 0.618 ? u + 0.382 : u - 0.618};
                  }),
                  sidak_level(30));
    }
}

TEST(LightRandom, IndependentSamplesAreIndependent) {
    for (std::uint32_t sample = 0; sample < 8; ++sample) {
        EXPECT_GT(p_value_over_pixels([&](Pixel p) {
                      return Vec2<double>{stretched(Sampler::independent, p, sample).x,
                                          stretched(Sampler::independent, p, sample + 1).x};
                  }),
                  sidak_level(8));
    }
}

/// Average over pixels of the chi-square statistic of 64 points, each made of one coordinate from each of two
/// padded pairs, in 8 x 8 cells.
double statistic_of_padding(const std::function<Vec2<double>(Pixel, std::uint32_t)>& f) {
    constexpr int kPixels = 400;
    double sum = 0;
    for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        int counts[64] = {};
        for (std::uint32_t k = 0; k < 64; ++k) {
            const Vec2<double> u = f({pixel, 3}, k);
            ++counts[static_cast<int>(u.x * 8) * 8 + static_cast<int>(u.y * 8)];
        }
        for (const int count : counts) sum += (count - 1.0) * (count - 1.0);
    }
    return sum / kPixels;
}

// In each block of eight consecutive samples, either coordinate has one sample in each eighth. If their orders are
// independent, the counts are sums of eight independent random permutation matrices, and the expectation is 64 * 7 /
// 8 = 56.
TEST(LightRandom, SobolPairsHaveIndependentOrders) {
    const double statistic = statistic_of_padding([](Pixel p, std::uint32_t k) {
        return Vec2<double>{random_numbers<double>(Sampler::sobol, 1, p.x, p.y, k, 64, 0).x,
                            random_numbers<double>(Sampler::sobol, 1, p.x, p.y, k, 64, 1).x};
    });
    EXPECT_NEAR(statistic, 56, 5);
    const double same_order = statistic_of_padding([](Pixel p, std::uint32_t k) {
        const UInt4 key = pcg4d({p.x, p.y, 0, 1});
        return Vec2<double>{to_unit<double>(owen_scrambled_sobol(k, {9, key.x, 0}).x),
                            to_unit<double>(owen_scrambled_sobol(k, {9, key.y, 0}).x)};
    });
    EXPECT_GT(same_order, 200);
}

TEST(LightRandom, PowersOfTwoSobolSamplesAreStratified) {
    for (const std::uint32_t n : {1u, 4u, 16u, 64u}) {
        for (std::uint32_t pixel = 0; pixel < 100; ++pixel) {
            std::vector<int> columns(n), rows(n);
            for (std::uint32_t k = 0; k < n; ++k) {
                const Vec2<float> u = random_numbers(Sampler::sobol, 2, pixel, 9, k, n, 1);
                ++columns[static_cast<std::size_t>(u.x * static_cast<float>(n))];
                ++rows[static_cast<std::size_t>(u.y * static_cast<float>(n))];
            }
            EXPECT_EQ(columns, std::vector<int>(n, 1));
            EXPECT_EQ(rows, std::vector<int>(n, 1));
        }
    }
}

TEST(LightRandom, JitteredSamplesShareTheirOffset) {
    for (const std::uint32_t n : {1u, 3u, 16u, 100u}) {
        for (std::uint32_t pixel = 0; pixel < 100; ++pixel) {
            const float first = random_numbers(Sampler::jittered, 2, pixel, 9, 0, n, 1).x;
            for (std::uint32_t k = 0; k < n; ++k) {
                const float x = random_numbers(Sampler::jittered, 2, pixel, 9, k, n, 1).x;
                EXPECT_NEAR(x, first + static_cast<float>(k) / static_cast<float>(n), 1.2e-7f);
                EXPECT_GE(x, static_cast<float>(k) / static_cast<float>(n));
                EXPECT_LT(x, static_cast<float>(k + 1) / static_cast<float>(n));
            }
        }
    }
}

/// The number of points in each cell of a grid.
std::vector<int> cells_of(const std::vector<Vec2<float>>& points, std::uint32_t columns, std::uint32_t rows) {
    std::vector<int> counts(columns * rows);
    for (const Vec2<float>& u : points)
        ++counts[static_cast<std::size_t>(static_cast<double>(u.x) * columns) * rows +
                 static_cast<std::size_t>(static_cast<double>(u.y) * rows)];
    return counts;
}

TEST(LightRandom, StratifiedSamplesAreStratifiedForAnyNumber) {
    const struct {
        std::uint32_t columns, rows;
    } grids[] = {{1, 1},   {1, 2},  {1, 3},  {2, 2},  {1, 5}, {2, 3},   {1, 7},   {2, 4},
                 {3, 4},   {4, 4},  {1, 19}, {5, 6},  {6, 6}, {8, 8},   {7, 11},  {8, 16},
                 {10, 10}, {1, 97}, {8, 9},  {7, 13}, {2, 7}, {24, 25}, {25, 40}, {32, 64}};
    for (const auto& grid : grids) {
        const std::uint32_t n = grid.columns * grid.rows;
        for (std::uint32_t pixel = 0; pixel < 50; ++pixel) {
            std::vector<Vec2<float>> points;
            for (std::uint32_t k = 0; k < n; ++k)
                points.push_back(random_numbers(Sampler::stratified, 2, pixel, 9, k, n, 1));
            const std::vector<int> one_each(n, 1);
            EXPECT_EQ(cells_of(points, n, 1), one_each);
            EXPECT_EQ(cells_of(points, 1, n), one_each);
            EXPECT_EQ(cells_of(points, grid.columns, grid.rows), one_each);
        }
    }
}

TEST(LightRandom, StratifiedSamplesAreUniformForAnyNumber) {
    constexpr std::uint32_t kNumbers[] = {1, 2, 3, 5, 6, 12, 13, 100};
    const double level = sidak_level(2 * static_cast<int>(std::size(kNumbers)));
    for (const std::uint32_t n : kNumbers)
        for (const std::uint32_t sample : {0u, n - 1})
            EXPECT_GT(p_value_over_pixels([&](Pixel p) {
                          return random_numbers<double>(Sampler::stratified, 4, p.x, p.y, sample, n, 0);
                      }),
                      level)
                << n;
}

TEST(LightRandom, StratifiedSamplesHaveIndependentPositionsInTheirStrata) {
    constexpr std::uint32_t n = 12;
    const auto in_stratum = [](double u) { return u * n - std::floor(u * n); };
    const auto number = [](Pixel p, std::uint32_t sample) {
        return random_numbers<double>(Sampler::stratified, 4, p.x, p.y, sample, n, 0);
    };
    for (std::uint32_t sample = 0; sample < 4; ++sample) {
        EXPECT_GT(
            p_value_over_pixels([&](Pixel p) {
                return Vec2<double>{in_stratum(number(p, sample).x), in_stratum(number(p, sample + 1).x)};
            }),
            sidak_level(8));
        EXPECT_GT(p_value_over_pixels([&](Pixel p) {
                      return Vec2<double>{in_stratum(number(p, sample).x), in_stratum(number(p, sample).y)};
                  }),
                  sidak_level(8));
    }
}

// If the orders of two pairs are independent, the counts of 64 samples in 8 x 8 cells are those of a random matching
// of strata. The variance of each is 64 * (1/8 * 7/8)^2 * 64 / 63, so the expected statistic of all cells is 49.8.
TEST(LightRandom, StratifiedPairsHaveIndependentOrders) {
    const double statistic = statistic_of_padding([](Pixel p, std::uint32_t k) {
        return Vec2<double>{random_numbers<double>(Sampler::stratified, 1, p.x, p.y, k, 64, 0).x,
                            random_numbers<double>(Sampler::stratified, 1, p.x, p.y, k, 64, 1).x};
    });
    EXPECT_NEAR(statistic, 49.8, 3);
}

TEST(LightRandom, StaysBelowOne) {
    for (const Sampler kind : kSamplers) {
        for (std::uint32_t i = 0; i < 300000; ++i) {
            const Vec2<float> u = random_numbers(kind, 0, i, 0, i % 64, 64, 0);
            ASSERT_TRUE(0 <= u.x && u.x < 1 && 0 <= u.y && u.y < 1) << i;
        }
    }
}

template <class Scalar, int N>
void expect_lanes_equal_scalars(std::uint32_t sample_count) {
    std::uint32_t x[N], y[N], sample[N];
    for (std::uint32_t i = 0; i < N; ++i) {
        x[i] = i % 4 + 100;
        y[i] = i / 4 + (i == 1 ? 0xfffffff0u : 0u);
        sample[i] = i * 5 % 16;
    }
    for (const Sampler kind : kSamplers) {
        Scalar light_x[N], light_y[N], camera_x[N], camera_y[N];
        light_random_lanes(kind, 77, x, y, sample, sample_count, 4, 2, light_x, light_y,
                           shipped_blue_noise());
        camera_random_lanes(kind, 77, x, y, sample, camera_x, camera_y);
        for (int i = 0; i < N; ++i) {
            const Vec2<Scalar> light =
                random_numbers<Scalar>(kind, 77, x[i], y[i], sample[i], sample_count, 4, 2);
            const Vec2<Scalar> camera = camera_random<Scalar>(kind, 77, x[i], y[i], sample[i]);
            EXPECT_EQ(light_x[i], light.x);
            EXPECT_EQ(light_y[i], light.y);
            EXPECT_EQ(camera_x[i], camera.x);
            EXPECT_EQ(camera_y[i], camera.y);
        }
    }
}

TEST(LightRandom, LanesEqualScalars) {
    for (const std::uint32_t sample_count : {16u, 17u, 30u, 72u, 1u << 20}) {
        expect_lanes_equal_scalars<float, 4>(sample_count);
        expect_lanes_equal_scalars<float, 8>(sample_count);
        expect_lanes_equal_scalars<float, 16>(sample_count);
        expect_lanes_equal_scalars<double, 2>(sample_count);
        expect_lanes_equal_scalars<double, 8>(sample_count);
    }
}

} // namespace
