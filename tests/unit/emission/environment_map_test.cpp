/// Tests of what is prepared once per environment map, and of exact sampling in texels.

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "emission/environments.h"

namespace nusselt_test {
namespace {

using nusselt::Vec2;
using nusselt::Vec3;
using nusselt::detail::BilinearTexel;

/// Noise over several orders of magnitude, with black texels.
MapTexels<double> rough_texels(int size) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    return {size, [&](int i, int j) {
                const double r = (3 * i + 5 * j) % 7 < 2 ? 0 : std::pow(uniform(random), 6);
                return Vec3<double>{r, r * uniform(random), 2 * r * uniform(random)};
            }};
}

/// Lookups at the centres of quarters have the mean of a texel as their mean, because they are bilinear in between.
TEST(EnvironmentMap, WeightsAreMeansOfLookups) {
    constexpr int kSize = 32;
    const MapTexels<double> texels = rough_texels(kSize);
    const StoredMap<double, 8> stored(texels.view());
    const auto& map = stored.map;
    std::vector<Vec3<double>> cells(64, {0, 0, 0});
    for (int j = 0; j < kSize; ++j) {
        for (int i = 0; i < kSize; ++i) {
            Vec3<double> mean{0, 0, 0};
            for (int k = 0; k < 4; ++k)
                mean += 0.25 * texels.view().lookup(Vec2<double>{(i + 0.25 + 0.5 * (k % 2)) / kSize,
                                                                 (j + 0.25 + 0.5 * (k / 2)) / kSize});
            ASSERT_NEAR(map.texel_weight(i, j), map.scale * mean_of_channels(mean), 1e-14);
            ASSERT_NEAR(map.texel_at(i, j).mean(), mean_of_channels(mean), 1e-14);
            cells[static_cast<std::size_t>(j / 4 * 8 + i / 4)] += mean / 16.0;
        }
    }
    Vec3<double> total{0, 0, 0};
    for (int cell = 0; cell < 64; ++cell) {
        const auto& expected = cells[static_cast<std::size_t>(cell)];
        EXPECT_NEAR(map.mean[0][cell], expected.x, 1e-14);
        EXPECT_NEAR(map.mean[1][cell], expected.y, 1e-14);
        EXPECT_NEAR(map.mean[2][cell], expected.z, 1e-14);
        EXPECT_NEAR(map.weight[cell], map.scale * mean_of_channels(expected), 1e-14);
        total += expected / 64.0;
    }
    EXPECT_LT(length(map.mean_radiance() - total), 1e-14);
    // No texel that lights something has the weight 0, also if it is black itself.
    for (int j = 0; j < kSize; ++j)
        for (int i = 0; i < kSize; ++i) EXPECT_GT(map.texel_weight(i, j), 0);
}

TEST(EnvironmentMap, DirectionsAreWeightedByRadiance) {
    constexpr int kSize = 64;
    const MapTexels<double> texels = rough_texels(kSize);
    const StoredMap<double, 8> stored(texels.view());
    const auto& map = stored.map;
    for (int level = 1; level < map.shape.levels; ++level) {
        const int width = map.shape.width_of(level);
        const int part = kSize / width;
        for (int j = 0; j < width; ++j) {
            for (int i = 0; i < width; ++i) {
                Vec3<double> sum{0, 0, 0};
                double weight = 0;
                for (int y = j * part; y < (j + 1) * part; ++y) {
                    for (int x = i * part; x < (i + 1) * part; ++x) {
                        sum += map.texel_weight(x, y) * texel_centre<double>(kSize, x, y);
                        weight += map.texel_weight(x, y);
                    }
                }
                // The lattice has arrays of its own.
                const bool is_cell = width == 8;
                const double* const numbers =
                    is_cell ? map.weight + j * 8 + i
                            : map.elements + map.element_index(level + 1, i / 2, j / 2) + map.part_of(i, j);
                const int stride = is_cell ? 0 : 4;
                const Vec3<double> found =
                    is_cell ? Vec3<double>{map.direction[0][j * 8 + i], map.direction[1][j * 8 + i],
                                           map.direction[2][j * 8 + i]}
                            : Vec3<double>{numbers[stride], numbers[2 * stride], numbers[3 * stride]};
                ASSERT_NEAR(numbers[0], weight / (part * part), 1e-15);
                ASSERT_LT(length(found - sum / weight), 1e-13);
            }
        }
    }
}

/// Where radiance is constant, a third of the trace of the covariance of directions in a cell, which is about a twelfth
/// of its solid angle in two of three directions.
TEST(EnvironmentMap, VariancesAreThoseOfDirections) {
    const auto texels = texels_of<double>(64, [](const auto&) { return grey<double>(1); });
    const StoredMap<double, 16> stored(texels.view());
    const auto& map = stored.map;
    for (int cell = 0; cell < 256; ++cell) {
        const double variance = map.variance_of(
            Vec3<double>{map.direction[0][cell], map.direction[1][cell], map.direction[2][cell]});
        // Cells where the map shears are longer.
        EXPECT_GT(variance, 0.95 * 2 / 3 * map.kCellAngle / 12);
        EXPECT_LT(variance, 2.2 * 2 / 3 * map.kCellAngle / 12);
    }
    EXPECT_EQ(map.variance_of(Vec3<double>{0, 0, 1}), map.texel_variance);
}

/// The storage is filled to its end, and not beyond.
TEST(EnvironmentMap, UsesItsStorage) {
    constexpr int kSize = 64;
    const int count = nusselt::EnvironmentMap<float, 16>::storage_size(kSize);
    EXPECT_EQ(count, 4096 + 16 * 256);
    EXPECT_EQ((nusselt::EnvironmentMap<float, 16>::storage_size(32)), 1024);
    const auto texels = texels_of<float>(kSize, [](const auto& w) { return grey<float>(sky(w)); });
    std::vector<float> storage(static_cast<std::size_t>(count) + 1, -7.0f);
    const auto map = nusselt::make_environment_map<16>(texels.view(), storage.data());
    EXPECT_EQ(map.texel_weights, storage.data());
    for (int k = 0; k < count; ++k) EXPECT_NE(storage[static_cast<std::size_t>(k)], -7) << k;
    EXPECT_EQ(storage.back(), -7);
}

/// Texels with zeros in all places.
std::vector<BilinearTexel<double>> some_texels() {
    std::vector<BilinearTexel<double>> texels;
    for (int pattern = 1; pattern < 512; pattern += 3) {
        BilinearTexel<double> texel;
        for (int k = 0; k < 9; ++k)
            texel.value[k / 3][k % 3] = (pattern >> k & 1) == 0 ? 0 : k % 4 == 3 ? 1e3 : 1 + 0.3 * k;
        texels.push_back(texel);
    }
    return texels;
}

TEST(BilinearTexel, DensityOfSamplesIsTheInterpolant) {
    constexpr int kSteps = 8;
    for (const BilinearTexel<double>& texel : some_texels()) {
        for (int k = 0; k < kSteps * kSteps; ++k) {
            const Vec2<double> u{(k % kSteps + 0.37) / kSteps, (k / kSteps + 0.61) / kSteps};
            const Vec2<double> x = texel.sample(u);
            ASSERT_TRUE(x.x >= 0 && x.x <= 1 && x.y >= 0 && x.y <= 1);
            const Vec2<double> again = texel.invert(x);
            ASSERT_NEAR(again.x, u.x, 1e-9);
            ASSERT_NEAR(again.y, u.y, 1e-9);
            // The Jacobian is the reciprocal density, unless a kink is next to x.
            if (std::fabs(x.x - 0.5) < 1e-3 || std::fabs(x.y - 0.5) < 1e-3) continue;
            constexpr double kStep = 1e-5;
            const double across =
                (texel.sample({u.x + kStep, u.y}).x - texel.sample({u.x - kStep, u.y}).x) / (2 * kStep);
            const double along =
                (texel.sample({u.x, u.y + kStep}).y - texel.sample({u.x, u.y - kStep}).y) / (2 * kStep);
            ASSERT_NEAR(across * along * texel.at(x) / texel.mean(), 1, 1e-4);
        }
    }
}

TEST(BilinearTexel, InterpolatesAsTheMap) {
    const MapTexels<double> texels = rough_texels(16);
    const StoredMap<double, 8> stored(texels.view());
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(0, 0.9999999);
    for (int k = 0; k < 1000; ++k) {
        const double x = uniform(random);
        const Vec2<double> at{x, uniform(random)};
        const int i = static_cast<int>(16 * at.x), j = static_cast<int>(16 * at.y);
        EXPECT_NEAR(stored.map.texel_at(i, j).at({16 * at.x - i, 16 * at.y - j}),
                    mean_of_channels(texels.view().lookup(at)), 1e-14);
    }
}

} // namespace
} // namespace nusselt_test
