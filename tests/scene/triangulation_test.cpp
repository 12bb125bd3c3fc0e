// Splitting of faces into triangles.

#include "scene/build/polygons/polygon_triangulation.h"
#include "scene/model/polygon.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

namespace nusselt::scene {
namespace {

/// Each triangle turns like the outline, and their areas add up to its area: they neither overlap nor leave gaps, as long
/// as the outline is simple.
void expect_partition(const std::vector<Double3>& corners) {
    const std::vector<Triangle> triangles = triangulate_polygon(corners);
    ASSERT_EQ(triangles.size(), corners.size() - 2);
    const Double3 normal = area_vector(corners);
    double sum = 0;
    for (const Triangle& t : triangles) {
        const Double3 area = area_vector({corners[t.vertex[0]], corners[t.vertex[1]], corners[t.vertex[2]]});
        EXPECT_GE(dot(area, normal), -1e-9 * dot(normal, normal));
        sum += length(area);
    }
    EXPECT_NEAR(sum, length(normal), 1e-9 * length(normal));
}

std::vector<Double3> reversed(std::vector<Double3> corners) { return {corners.rbegin(), corners.rend()}; }

TEST(Triangulation, ConvexFacesAreFans) {
    const std::vector<Double3> corners = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}};
    const std::vector<Triangle> triangles = triangulate_polygon(corners);
    ASSERT_EQ(triangles.size(), 3u);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(triangles[i].vertex[0], 0u);
        EXPECT_EQ(triangles[i].vertex[1], i + 1);
        EXPECT_EQ(triangles[i].vertex[2], i + 2);
    }
    EXPECT_TRUE(triangulate_polygon({}).empty());
    EXPECT_TRUE(triangulate_polygon({{0, 0, 0}, {1, 0, 0}}).empty());
}

TEST(Triangulation, ConcaveFacesInAllPlanes) {
    // A comb, in planes across each axis and in between, in both directions.
    const double comb[][2] = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                              {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
    const Double3 frames[][2] = {{{1, 0, 0}, {0, 1, 0}},
                                 {{0, 1, 0}, {0, 0, 1}},
                                 {{0, 0, 1}, {1, 0, 0}},
                                 {{0.6, 0.8, 0}, {-0.48, 0.36, 0.8}}};
    for (const auto& [x, y] : frames) {
        std::vector<Double3> corners;
        for (const auto& [a, b] : comb) corners.push_back(Double3{3, -2, 1} + a * x + b * y);
        for (std::size_t first = 0; first < corners.size(); ++first) {
            std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            expect_partition(corners);
            expect_partition(reversed(corners));
        }
    }
}

TEST(Triangulation, RandomStars) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> radius(0.05, 1);
    for (int repetition = 0; repetition < 300; ++repetition) {
        std::vector<Double3> corners;
        const int n = 4 + repetition % 60;
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * i / n;
            const double r = radius(random);
            corners.push_back({r * std::cos(angle), r * std::sin(angle), 0.5});
        }
        expect_partition(corners);
    }
}

TEST(Triangulation, OutlinesWithAHoleAndABridge) {
    // A square with a square hole; the outline goes to the hole and back along the same line.
    expect_partition({{0, 0, 0},
                      {4, 0, 0},
                      {4, 4, 0},
                      {0, 4, 0},
                      {0, 0, 0},
                      {1, 1, 0},
                      {1, 3, 0},
                      {3, 3, 0},
                      {3, 1, 0},
                      {1, 1, 0}});
}

TEST(Triangulation, StraightCornersGiveNoFlatTriangles) {
    const std::vector<Double3> corners = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}};
    for (const Triangle& t : triangulate_polygon(corners))
        EXPECT_GT(length(area_vector({corners[t.vertex[0]], corners[t.vertex[1]], corners[t.vertex[2]]})),
                  0.1);
}

TEST(Triangulation, FacesThatMakeNoSenseStillEnd) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(triangulate_polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u); // a bow tie
    EXPECT_EQ(triangulate_polygon({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).size(), 3u);
    EXPECT_EQ(triangulate_polygon({{0, 0, 0}, {nan, 1, 0}, {1, nan, 0}, {0, 1, 0}}).size(), 2u);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    std::vector<Double3> tangle(200);
    for (Double3& p : tangle) p = {anywhere(random), anywhere(random), anywhere(random)};
    EXPECT_EQ(triangulate_polygon(tangle).size(), 198u);
}

TEST(Triangulation, LargeFacesMustBeConvex) {
    std::vector<Double3> corners;
    for (std::size_t i = 0; i < 4 * kMaxConcaveCorners; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / (4 * kMaxConcaveCorners);
        corners.push_back({std::cos(angle), std::sin(angle), 0});
    }
    EXPECT_EQ(triangulate_polygon(corners).size(), corners.size() - 2);
    corners[0] = {0, 0, 0};
    EXPECT_THROW(triangulate_polygon(corners), std::runtime_error);
    corners.resize(kMaxConcaveCorners);
    expect_partition(corners);
}

} // namespace
} // namespace nusselt::scene
