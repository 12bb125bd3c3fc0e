/// Tests of what is prepared once per light: means of filtered textures, pyramids, cells, and outlines.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "emission/textured_lights.h"

namespace nusselt_test {
namespace {

using nusselt::BilinearFilter;
using nusselt::NearestFilter;
using nusselt::PyramidShape;
using nusselt::TextureView;
using nusselt::Vec2;
using Colour = nusselt::Vec3<double>;

std::vector<Colour> random_texels(int count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Colour> texels;
    for (int k = 0; k < count; ++k) {
        const double r = uniform(random), g = uniform(random);
        texels.push_back({r, g, uniform(random)});
    }
    return texels;
}

/// The mean over a rectangle by many lookups.
template <class Filter>
Colour mean_of_lookups(const TextureView<double>& texture, const Vec2<double>& low,
                       const Vec2<double>& high) {
    constexpr int kSteps = 400;
    Colour sum{0, 0, 0};
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i)
            sum += Filter::lookup(texture, {low.x + (i + 0.5) / kSteps * (high.x - low.x),
                                            low.y + (j + 0.5) / kSteps * (high.y - low.y)});
    return sum / static_cast<double>(kSteps * kSteps);
}

template <class Filter>
class FilterTest : public ::testing::Test {};
using Filters = ::testing::Types<NearestFilter, BilinearFilter>;
TYPED_TEST_SUITE(FilterTest, Filters);

/// Rectangles at the corners, inside, and not aligned with texels.
TYPED_TEST(FilterTest, MeansAreThoseOfLookups) {
    const std::vector<Colour> texels = random_texels(15);
    const TextureView<double> texture{texels.data(), 5, 3};
    const std::vector<std::vector<Vec2<double>>> rectangles = {
        {{0, 0}, {0.2, 1.0 / 3}},    {{0.4, 1.0 / 3}, {0.6, 2.0 / 3}}, {{0.8, 2.0 / 3}, {1, 1}},
        {{0.375, 0.25}, {0.5, 0.5}}, {{0.875, 0.75}, {1, 1}},          {{0, 0}, {0.125, 0.25}},
    };
    for (const auto& rectangle : rectangles) {
        const Colour expected = mean_of_lookups<TypeParam>(texture, rectangle[0], rectangle[1]);
        const Colour mean = mean_radiance<TypeParam>(texture, rectangle[0], rectangle[1]);
        EXPECT_NEAR(mean.x, expected.x, 3e-3);
        EXPECT_NEAR(mean.y, expected.y, 3e-3);
        EXPECT_NEAR(mean.z, expected.z, 3e-3);
    }
}

TEST(BilinearFilter, MeanOverATexelIsSeparable) {
    const auto shares = BilinearFilter::shares(3.0, 4.0, 8);
    ASSERT_EQ(shares.count, 3);
    EXPECT_EQ(shares.first, 2);
    EXPECT_EQ(shares.share[0], 1.0 / 8);
    EXPECT_EQ(shares.share[1], 6.0 / 8);
    EXPECT_EQ(shares.share[2], 1.0 / 8);
    // The texel at the edge goes on beyond it.
    const auto at_edge = BilinearFilter::shares(0.0, 1.0, 8);
    EXPECT_EQ(at_edge.first, 0);
    EXPECT_EQ(at_edge.count, 2);
    EXPECT_EQ(at_edge.share[0], 7.0 / 8);
    EXPECT_EQ(at_edge.share[1], 1.0 / 8);
}

TEST(PyramidShape, HalvesBothSidesDownToTheLattice) {
    const PyramidShape shape(8, 100, 9);
    EXPECT_EQ(shape.width_of(0), 128);
    EXPECT_EQ(shape.height_of(0), 16);
    EXPECT_EQ(shape.levels, 5);
    EXPECT_EQ(shape.height_of(1), 8);
    EXPECT_EQ(shape.height_of(2), 8);
    EXPECT_EQ(shape.width_of(4), 8);
    EXPECT_EQ(shape.size, 128 * 16 + 64 * 8 + 32 * 8 + 16 * 8 + 8 * 8);
}

/// Textures of all sizes, with the lattice and the outline at any position relative to their texels.
TYPED_TEST(FilterTest, CellsHaveTheMeansOfTheirParts) {
    const std::vector<Colour> texels = random_texels(40 * 24);
    for (const auto& size : {Vec2<int>{40, 24}, Vec2<int>{16, 16}, Vec2<int>{3, 2}, Vec2<int>{1, 1}}) {
        const TextureView<double> texture{texels.data(), size.x, size.y};
        for (const auto& outline : outlines<double>()) {
            const StoredLight<double, 8> stored(TypeParam(), texture, outline);
            const auto& light = stored.light;
            constexpr int kSteps = 480; // a multiple of all numbers of texels and cells
            std::vector<Colour> sum(64, Colour{0, 0, 0});
            std::vector<int> count(64, 0);
            Colour total{0, 0, 0};
            int inside = 0;
            for (int j = 0; j < kSteps; ++j) {
                for (int i = 0; i < kSteps; ++i) {
                    const Vec2<double> at{(i + 0.5) / kSteps, (j + 0.5) / kSteps};
                    if (!light.outline.contains(at, at)) continue;
                    const Colour radiance = TypeParam::lookup(texture, at);
                    const auto cell = static_cast<std::size_t>(j / 60 * 8 + i / 60);
                    sum[cell] += radiance;
                    ++count[cell];
                    total += radiance;
                    ++inside;
                }
            }
            EXPECT_NEAR(light.covered(), static_cast<double>(inside) / (kSteps * kSteps), 1e-3);
            EXPECT_NEAR(light.mean_radiance().y, total.y / inside, 2e-3);
            // A plane of two square metres.
            EXPECT_NEAR(light.flux(2).x, 2 * nusselt::kPi<double> * total.x / (kSteps * kSteps), 4e-2);
            for (std::size_t cell = 0; cell < 64; ++cell) {
                EXPECT_NEAR(light.cover[cell], count[cell] / 3600.0, 0.02);
                // Elements that the outline cuts count with their whole mean.
                const bool whole = count[cell] == 3600;
                if (whole || (count[cell] > 400 && size.x >= 16)) {
                    const double expected = sum[cell].z / count[cell];
                    EXPECT_NEAR(light.mean[2][cell], expected, whole ? 1e-3 : 0.1);
                }
                const double weight = (light.mean[0][cell] + light.mean[1][cell] + light.mean[2][cell]) / 3;
                EXPECT_NEAR(light.weight[cell], weight, 1e-12);
            }
        }
    }
}

TEST(TexturedLight, GridsAreMeansOfFinerOnes) {
    const std::vector<Colour> texels = random_texels(64 * 16);
    const StoredLight<double, 8> stored(NearestFilter(), {texels.data(), 64, 16}, unit_square<double>());
    const auto& pyramid = stored.light.pyramid;
    const double fine = pyramid.at(1, 6, 3) + pyramid.at(1, 7, 3);
    EXPECT_NEAR(pyramid.at(2, 3, 3), fine / 2, 1e-15);
    for (int cell = 0; cell < 64; ++cell)
        EXPECT_NEAR(pyramid.at(pyramid.shape.levels - 1, cell % 8, cell / 8), stored.light.weight[cell],
                    1e-14);
    // One bright texel of 16 in a cell: the mean of squares is 16 times the square of the mean.
    std::vector<Colour> spike(32 * 32, Colour{0, 0, 0});
    spike[0] = {3, 3, 3};
    const StoredLight<double, 8> spiky(NearestFilter(), {spike.data(), 32, 32}, unit_square<double>());
    EXPECT_NEAR(spiky.light.variation[0], 15, 1e-12);
    EXPECT_EQ(spiky.light.variation[1], 0);
    EXPECT_EQ(spiky.light.weight[1], 0);
}

} // namespace
} // namespace nusselt_test
