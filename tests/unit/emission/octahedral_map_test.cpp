/// Tests of the maps between directions and squares, and of interpolation across the edges of octahedral maps.

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/emission/latitude_longitude.h>
#include <nusselt/emission/octahedral_map.h>
#include <nusselt/simd/pack.h>

namespace nusselt_test {
namespace {

using nusselt::octahedral_coordinates;
using nusselt::octahedral_direction;
using nusselt::Vec2;
using nusselt::Vec3;

template <class T>
class SphereMapTest : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(SphereMapTest, Scalars);

/// Axes, poles, the equator, diagonals, and directions next to all of these, with both signs of zero.
template <class T>
std::vector<Vec3<T>> hostile_directions() {
    std::vector<T> components;
    for (const double x : {0.0, 1e-40, 1e-30, 1e-20, 1e-10, 1e-7, 1e-4, 0.3, 0.9999999, 1.0}) {
        components.push_back(static_cast<T>(x));
        components.push_back(-static_cast<T>(x));
    }
    std::vector<Vec3<T>> directions;
    for (const T x : components)
        for (const T y : components)
            for (const T z : components)
                if (length(Vec3<T>{x, y, z}) > T(0.2)) directions.push_back(normalize(Vec3<T>{x, y, z}));
    return directions;
}

/// The square from edge to edge, with points next to seams, diagonals and the centre.
template <class T>
std::vector<Vec2<T>> hostile_points() {
    std::vector<T> numbers;
    for (const double x : {0.0, 1e-40, 1e-20, 1e-8, 1e-3, 0.25, 0.4999999})
        for (const double y : {x, 0.5 - x, 0.5 + x, 1 - x}) numbers.push_back(static_cast<T>(y));
    std::vector<Vec2<T>> points;
    for (const T x : numbers)
        for (const T y : numbers) points.push_back({x, y});
    return points;
}

TYPED_TEST(SphereMapTest, OctahedralDirectionsComeBack) {
    using T = TypeParam;
    const T tolerance = 8 * std::numeric_limits<T>::epsilon();
    for (const Vec3<T>& w : hostile_directions<T>()) {
        const Vec2<T> at = octahedral_coordinates(w);
        ASSERT_TRUE(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1) << w.x << ' ' << w.y << ' ' << w.z;
        ASSERT_LT(length(octahedral_direction(at) - w), tolerance) << w.x << ' ' << w.y << ' ' << w.z;
    }
}

TYPED_TEST(SphereMapTest, PointsOfTheSquareComeBack) {
    using T = TypeParam;
    const T epsilon = std::numeric_limits<T>::epsilon();
    for (const Vec2<T>& at : hostile_points<T>()) {
        const Vec3<T> w = octahedral_direction(at);
        ASSERT_LT(std::fabs(length(w) - 1), 4 * epsilon);
        const Vec2<T> again = octahedral_coordinates(w);
        ASSERT_LT(length(octahedral_direction(again) - w), 8 * epsilon) << at.x << ' ' << at.y;
        // On an edge, the mirror image is the same direction.
        const T edge = std::min(std::min(at.x, 1 - at.x), std::min(at.y, 1 - at.y));
        if (edge > 4 * epsilon) {
            ASSERT_LE(std::fabs(again.x - at.x), 4 * epsilon) << at.x << ' ' << at.y;
            ASSERT_LE(std::fabs(again.y - at.y), 4 * epsilon) << at.x << ' ' << at.y;
        }
    }
}

TYPED_TEST(SphereMapTest, LatitudesAndLongitudesComeBack) {
    using T = TypeParam;
    const T tolerance = 8 * std::numeric_limits<T>::epsilon();
    for (const Vec3<T>& w : hostile_directions<T>()) {
        const Vec2<T> at = nusselt::latitude_longitude_coordinates(w);
        ASSERT_TRUE(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1);
        ASSERT_LT(length(nusselt::latitude_longitude_direction(at) - w), tolerance)
            << w.x << ' ' << w.y << ' ' << w.z;
    }
    for (const Vec2<T>& at : hostile_points<T>())
        ASSERT_LT(std::fabs(length(nusselt::latitude_longitude_direction(at)) - 1), tolerance);
}

TEST(OctahedralMap, HasTheAxesOfPbrt) {
    const auto expect = [](const Vec2<double>& at, const Vec3<double>& w) {
        EXPECT_LT(length(octahedral_direction(at) - w), 1e-15);
    };
    expect({0.5, 0.5}, {0, 0, 1});
    expect({1, 0.5}, {1, 0, 0});
    expect({0, 0.5}, {-1, 0, 0});
    expect({0.5, 1}, {0, 1, 0});
    expect({0.5, 0}, {0, -1, 0});
    for (const double x : {0.0, 1.0})
        for (const double y : {0.0, 1.0}) expect({x, y}, {0, 0, -1});
    // Clarberg's formula with the angle from the diagonal.
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < 1000; ++k) {
        const double u = uniform(random), v = uniform(random);
        const double d = 1 - std::fabs(u) - std::fabs(v);
        const double r = 1 - std::fabs(d);
        const double phi = nusselt::kPi<double> / 4 * ((std::fabs(v) - std::fabs(u)) / r + 1);
        const double across = r * std::sqrt(2 - r * r);
        expect({(u + 1) / 2, (v + 1) / 2},
               {std::copysign(across * std::cos(phi), u), std::copysign(across * std::sin(phi), v),
                std::copysign(1 - r * r, d)});
    }
}

/// Solid angle per area of the square.
template <class Map>
double stretch(const Map& map, const Vec2<double>& at) {
    constexpr double kStep = 1e-6;
    const Vec3<double> x = map(Vec2<double>{at.x + kStep, at.y}) - map(Vec2<double>{at.x - kStep, at.y});
    const Vec3<double> y = map(Vec2<double>{at.x, at.y + kStep}) - map(Vec2<double>{at.x, at.y - kStep});
    return length(cross(x, y)) / (4 * kStep * kStep);
}

TEST(OctahedralMap, KeepsAreas) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    // The octahedron itself has corners where the stretch is not the same.
    const auto flat = [](const Vec2<double>& at) {
        const double u = 2 * at.x - 1, v = 2 * at.y - 1;
        const double d = 1 - std::fabs(u) - std::fabs(v);
        return normalize(Vec3<double>{d < 0 ? std::copysign(1 - std::fabs(v), u) : u,
                                      d < 0 ? std::copysign(1 - std::fabs(u), v) : v, d});
    };
    double worst = 0, worst_flat = 0;
    for (int k = 0; k < 2000; ++k) {
        const double x = uniform(random);
        const Vec2<double> at{x, uniform(random)};
        const double u = std::fabs(2 * at.x - 1), v = std::fabs(2 * at.y - 1);
        // Its derivatives jump on the axes and the equator.
        if (std::min({u, v, 1 - u, 1 - v, std::fabs(1 - u - v)}) < 1e-4) continue;
        const double sphere = 4 * nusselt::kPi<double>;
        worst = std::max(worst, std::fabs(stretch(octahedral_direction<double>, at) / sphere - 1));
        worst_flat = std::max(worst_flat, std::fabs(stretch(flat, at) / sphere - 1));
    }
    EXPECT_LT(worst, 1e-6);
    EXPECT_GT(worst_flat, 0.5);
}

TEST(LatitudesAndLongitudes, RowsHaveTheirSolidAngle) {
    const double pi = nusselt::kPi<double>;
    for (const double y : {0.01, 0.3, 0.5, 0.99})
        for (const double x : {0.1, 0.4, 0.7, 0.95})
            EXPECT_NEAR(stretch(nusselt::latitude_longitude_direction<double>, {x, y}),
                        2 * pi * pi * std::sin(pi * y), 1e-6);
    const auto w = nusselt::latitude_longitude_direction(Vec2<double>{0.25, 0.5});
    EXPECT_NEAR(w.y, 1, 1e-15);
    EXPECT_EQ(nusselt::latitude_longitude_direction(Vec2<double>{0.3, 0}).z, 1);
}

TEST(OctahedralMap, PacksAgreeWithScalars) {
    using Pack = nusselt::Pack<float, 8>;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 0.9999999f);
    for (int k = 0; k < 100; ++k) {
        Vec2<Pack> at{Pack(0.0f), Pack(0.0f)};
        for (int lane = 0; lane < 8; ++lane) {
            at.x.set_lane(lane, uniform(random));
            at.y.set_lane(lane, uniform(random));
        }
        const Vec3<Pack> w = octahedral_direction(at);
        const Vec2<Pack> again = octahedral_coordinates(w);
        const Vec2<Pack> image = nusselt::latitude_longitude_coordinates(w);
        for (int lane = 0; lane < 8; ++lane) {
            const Vec3<float> single = octahedral_direction(Vec2<float>{at.x.lane(lane), at.y.lane(lane)});
            ASSERT_NEAR(w.x.lane(lane), single.x, 1e-6);
            ASSERT_NEAR(w.y.lane(lane), single.y, 1e-6);
            ASSERT_NEAR(w.z.lane(lane), single.z, 1e-6);
            ASSERT_NEAR(again.x.lane(lane), at.x.lane(lane), 1e-6);
            ASSERT_NEAR(again.y.lane(lane), at.y.lane(lane), 1e-6);
            ASSERT_NEAR(image.x.lane(lane), nusselt::latitude_longitude_coordinates(single).x, 1e-6);
        }
    }
}

std::vector<Vec3<double>> random_texels(int size) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Vec3<double>> texels;
    for (int k = 0; k < size * size; ++k) {
        const double r = uniform(random), g = uniform(random);
        texels.push_back({r, g, uniform(random)});
    }
    return texels;
}

Vec3<double> centre(int size, int i, int j) {
    return octahedral_direction(Vec2<double>{(i + 0.5) / size, (j + 0.5) / size});
}

/// Neighbours across an edge are neighbours on the sphere.
TEST(OctahedralMap, IndicesWrapToTheNearestTexels) {
    constexpr int kSize = 32;
    // The largest distance between neighbours inside of the square, on the diagonals of the octahedron.
    double inside = 0, across = 0, repeated = 0;
    for (int j = 0; j < kSize; ++j) {
        for (int i = -1; i < kSize; ++i) {
            const auto distance = [&](const Vec2<int>& a, const Vec2<int>& b) {
                return length(centre(kSize, a.x, a.y) - centre(kSize, b.x, b.y));
            };
            if (i >= 0 && i + 1 < kSize) {
                inside = std::max(inside, distance({i, j}, {i + 1, j}));
                continue;
            }
            const int beyond = i < 0 ? -1 : kSize;
            const int edge = i < 0 ? 0 : kSize - 1;
            across = std::max(across, distance({edge, j}, nusselt::wrap_octahedral(beyond, j, kSize)));
            across = std::max(across, distance({j, edge}, nusselt::wrap_octahedral(j, beyond, kSize)));
            repeated = std::max(repeated, distance({edge, j}, {kSize - 1 - edge, j}));
        }
    }
    EXPECT_LE(across, inside);
    EXPECT_GT(repeated, inside);
    for (const int i : {-1, kSize}) {
        for (const int j : {-1, kSize}) {
            // All four corners meet at -z; across both edges is the one opposite.
            const Vec2<int> corner = nusselt::wrap_octahedral(i, j, kSize);
            EXPECT_EQ(corner.x, i < 0 ? kSize - 1 : 0);
            EXPECT_EQ(corner.y, j < 0 ? kSize - 1 : 0);
        }
    }
}

TEST(OctahedralMap, LookupsInterpolateBetweenCentres) {
    constexpr int kSize = 8;
    const auto texels = random_texels(kSize);
    const nusselt::OctahedralMap<double> map{texels.data(), kSize};
    for (int j = 0; j < kSize; ++j) {
        for (int i = 0; i < kSize; ++i) {
            const Vec3<double>& texel = map.at(i, j);
            EXPECT_LT(length(map.lookup(centre(kSize, i, j)) - texel), 1e-13);
            EXPECT_LT(length(map.lookup(Vec2<double>{(i + 0.5) / kSize, (j + 0.5) / kSize}) - texel), 1e-13);
            if (i + 1 == kSize || j + 1 == kSize) continue;
            const Vec3<double> middle =
                0.25 * (texel + map.at(i + 1, j) + map.at(i, j + 1) + map.at(i + 1, j + 1));
            EXPECT_LT(length(map.lookup(Vec2<double>{(i + 1.0) / kSize, (j + 1.0) / kSize}) - middle), 1e-13);
        }
    }
}

/// Between directions on both sides of an edge, and on an edge itself.
TEST(OctahedralMap, LookupsAreContinuousAcrossEdges) {
    constexpr int kSize = 8;
    const auto texels = random_texels(kSize);
    const nusselt::OctahedralMap<double> map{texels.data(), kSize};
    const nusselt::TextureView<double> clamped{texels.data(), kSize, kSize};
    double jump = 0, jump_of_clamped = 0;
    for (int k = 0; k <= 200; ++k) {
        const double x = k / 200.0;
        for (const double edge : {0.0, 1.0}) {
            EXPECT_LT(length(map.lookup(Vec2<double>{x, edge}) - map.lookup(Vec2<double>{1 - x, edge})),
                      1e-14);
            EXPECT_LT(length(map.lookup(Vec2<double>{edge, x}) - map.lookup(Vec2<double>{edge, 1 - x})),
                      1e-14);
            const auto jump_between = [&](const auto& lookup) {
                return length(lookup(Vec2<double>{x, edge}) - lookup(Vec2<double>{1 - x, edge}));
            };
            jump_of_clamped = std::max(jump_of_clamped, jump_between([&](const Vec2<double>& at) {
                                           return nusselt::BilinearFilter::lookup(clamped, at);
                                       }));
        }
    }
    // Around the lower pole and along the lower half of the meridians y = 0 and x = 0, where the edges are.
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < 4000; ++k) {
        Vec3<double> w{uniform(random), uniform(random), -0.1 - std::fabs(uniform(random))};
        Vec3<double> step{0, 1e-7, 0};
        if (k % 3 == 0) w.y = 0;
        if (k % 3 == 1) w.x = 0;
        if (k % 3 == 1) step = {1e-7, 0, 0};
        if (k % 3 == 2) w = {1e-7 * w.x, 1e-7 * w.y, -1};
        jump = std::max(jump, length(map.lookup(normalize(w + step)) - map.lookup(normalize(w - step))));
    }
    EXPECT_LT(jump, 1e-5);
    EXPECT_GT(jump_of_clamped, 0.3);
}

} // namespace
} // namespace nusselt_test
