// Merging of coplanar emissive triangles.

#include "scene/build/polygons/polygon_merge.h"
#include "scene/model/polygon.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace nusselt::scene {
namespace {

struct Soup {
    std::vector<Float3> positions;
    std::vector<Triangle> triangles;

    void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        triangles.push_back({{a, b, c}});
        triangles.push_back({{a, c, d}});
    }
};

double area(const PolygonVertices& vertices) {
    std::vector<Double3> points;
    for (const Float3& v : vertices) points.push_back(to_double(v));
    return 0.5 * length(area_vector(points));
}

/// Each triangle belongs to one polygon; areas agree; all polygons are convex, planar, oriented to +z.
void expect_partition(const Soup& soup, const PolygonPartition& partition) {
    std::vector<double> triangle_area(partition.polygons.size(), 0);
    ASSERT_EQ(partition.polygon_of_triangle.size(), soup.triangles.size());
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        const Triangle& t = soup.triangles[i];
        triangle_area.at(static_cast<std::size_t>(partition.polygon_of_triangle[i])) +=
            area({soup.positions[t.vertex[0]], soup.positions[t.vertex[1]], soup.positions[t.vertex[2]]});
    }
    for (std::size_t i = 0; i < partition.polygons.size(); ++i) {
        EXPECT_NEAR(area(partition.polygons[i]), triangle_area[i], 1e-5 * triangle_area[i]);
        std::vector<Double3> points;
        for (const Float3& v : partition.polygons[i]) points.push_back(to_double(v));
        EXPECT_EQ(find_polygon_defect(points), std::nullopt);
        EXPECT_GT(area_vector(points).z, 0);
    }
}

std::vector<PolygonVertices> polygons_of(const Soup& soup) {
    return merge_coplanar_triangles(soup.positions, soup.triangles).polygons;
}

Soup grid(std::uint32_t columns, std::uint32_t rows) {
    Soup soup;
    for (std::uint32_t y = 0; y <= rows; ++y)
        for (std::uint32_t x = 0; x <= columns; ++x)
            soup.positions.push_back({static_cast<float>(x), 0.37f * static_cast<float>(y), 1});
    const std::uint32_t stride = columns + 1;
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x)
            soup.add_quad(y * stride + x, y * stride + x + 1, (y + 1) * stride + x + 1, (y + 1) * stride + x);
    return soup;
}

Soup fan_of(std::uint32_t corners) {
    Soup soup;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * std::acos(-1.0) * i / corners;
        soup.positions.push_back(
            {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
    }
    for (std::uint32_t i = 1; i + 1 < corners; ++i) soup.triangles.push_back({{0, i, i + 1}});
    return soup;
}

TEST(PolygonMerge, QuadBecomesOnePolygon) {
    const Soup soup = grid(1, 1);
    const auto partition = merge_coplanar_triangles(soup.positions, soup.triangles);
    const auto& polygons = partition.polygons;
    ASSERT_EQ(polygons.size(), 1u);
    EXPECT_EQ(polygons[0].size(), 4u);
    EXPECT_EQ(partition.polygon_of_triangle, (std::vector<std::int32_t>{0, 0}));
    expect_partition(soup, partition);
}

TEST(PolygonMerge, StripsAndGridsBecomeRectangles) {
    for (const auto& [columns, rows] : {std::pair{7u, 1u}, {1u, 9u}, {6u, 5u}, {20u, 20u}}) {
        const Soup soup = grid(columns, rows);
        const auto partition = merge_coplanar_triangles(soup.positions, soup.triangles);
        const auto& polygons = partition.polygons;
        ASSERT_EQ(polygons.size(), 1u) << columns << " x " << rows;
        EXPECT_EQ(polygons[0].size(), 4u);
        expect_partition(soup, partition);
    }
}

TEST(PolygonMerge, VerticesAreComparedByPosition) {
    Soup soup = grid(3, 2);
    Soup separate;
    for (const Triangle& t : soup.triangles) {
        const auto first = static_cast<std::uint32_t>(separate.positions.size());
        for (const std::uint32_t vertex : t.vertex) separate.positions.push_back(soup.positions[vertex]);
        separate.triangles.push_back({{first, first + 1, first + 2}});
    }
    EXPECT_EQ(polygons_of(separate).size(), 1u);
}

TEST(PolygonMerge, FansStopAtEightVertices) {
    for (std::uint32_t corners = 3; corners <= 8; ++corners) {
        const Soup soup = fan_of(corners);
        const auto partition = merge_coplanar_triangles(soup.positions, soup.triangles);
        const auto& polygons = partition.polygons;
        ASSERT_EQ(polygons.size(), 1u);
        EXPECT_EQ(polygons[0].size(), corners);
        expect_partition(soup, partition);
    }
    const Soup soup = fan_of(12);
    const auto partition = merge_coplanar_triangles(soup.positions, soup.triangles);
    const auto& polygons = partition.polygons;
    EXPECT_EQ(polygons.size(), 2u);
    expect_partition(soup, partition);
}

TEST(PolygonMerge, FanAroundACentreLosesTheCentre) {
    Soup soup = fan_of(8);
    soup.positions.push_back({0, 0, 0});
    soup.triangles.clear();
    for (std::uint32_t i = 0; i < 8; ++i) soup.triangles.push_back({{8, i, (i + 1) % 8}});
    const auto partition = merge_coplanar_triangles(soup.positions, soup.triangles);
    const auto& polygons = partition.polygons;
    expect_partition(soup, partition);
    ASSERT_EQ(polygons.size(), 1u);
    EXPECT_EQ(polygons[0].size(), 8u);
}

TEST(PolygonMerge, LShapesStaySplit) {
    Soup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    soup.add_quad(0, 1, 4, 5);
    soup.add_quad(1, 2, 3, 4);
    soup.add_quad(5, 4, 6, 7);
    const auto partition = merge_coplanar_triangles(soup.positions, soup.triangles);
    const auto& polygons = partition.polygons;
    EXPECT_EQ(polygons.size(), 2u);
    expect_partition(soup, partition);
}

TEST(PolygonMerge, RingsKeepTheirHole) {
    Soup soup = grid(3, 3);
    soup.triangles.erase(soup.triangles.begin() + 8, soup.triangles.begin() + 10); // the middle
    const auto partition = merge_coplanar_triangles(soup.positions, soup.triangles);
    const auto& polygons = partition.polygons;
    EXPECT_EQ(polygons.size(), 4u);
    expect_partition(soup, partition);
}

TEST(PolygonMerge, BentAndOpposedTrianglesStaySplit) {
    Soup bent;
    bent.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.01f}};
    bent.add_quad(0, 1, 2, 3);
    EXPECT_EQ(polygons_of(bent).size(), 2u);

    Soup sheet; // both sides of one triangle
    sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    sheet.triangles = {{{0, 1, 2}}, {{0, 2, 1}}};
    EXPECT_EQ(polygons_of(sheet).size(), 2u);

    Soup doubled; // the same triangle twice
    doubled.positions = sheet.positions;
    doubled.triangles = {{{0, 1, 2}}, {{0, 1, 2}}};
    EXPECT_EQ(polygons_of(doubled).size(), 2u);
}

TEST(PolygonMerge, ApartButCoplanarTrianglesStaySplit) {
    Soup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    soup.triangles = {{{0, 1, 2}}, {{3, 4, 5}}};
    EXPECT_EQ(polygons_of(soup).size(), 2u);
}

TEST(PolygonMerge, RandomPiecesOfGridsArePartitioned) {
    std::mt19937 random(7);
    for (int repetition = 0; repetition < 200; ++repetition) {
        Soup soup = grid(6, 6);
        std::shuffle(soup.triangles.begin(), soup.triangles.end(), random);
        soup.triangles.resize(1 + random() % soup.triangles.size());
        expect_partition(soup, merge_coplanar_triangles(soup.positions, soup.triangles));
    }
}

TEST(PolygonMerge, ThirdTrianglesAtAnEdgeSeparate) {
    Soup fins; // three triangles around the edge from 0 to 1, two of them in one plane
    fins.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    fins.triangles = {{{0, 1, 2}}, {{0, 3, 1}}, {{0, 1, 4}}};
    EXPECT_EQ(polygons_of(fins).size(), 3u);
}

TEST(PolygonMerge, OverlappingTrianglesAreNotOnePolygon) {
    // Eight triangles around a point that go around it twice: their outline is a closed loop, but it covers more
    // area than it encloses.
    Soup soup = fan_of(4);
    soup.positions.push_back({0, 0, 0});
    soup.triangles.clear();
    for (std::uint32_t i = 0; i < 4; ++i) soup.positions.push_back(soup.positions[i]);
    for (std::uint32_t i = 5; i < 9; ++i) {
        soup.positions[i].x *= 1.5f;
        soup.positions[i].y *= 1.5f;
    }
    const std::uint32_t ring[] = {0, 6, 2, 8, 5, 1, 7, 3}; // every step a quarter
    for (std::uint32_t i = 0; i < 8; ++i) soup.triangles.push_back({{4, ring[i], ring[(i + 1) % 8]}});
    const auto partition = merge_coplanar_triangles(soup.positions, soup.triangles);
    EXPECT_GT(partition.polygons.size(), 1u);
    double sum = 0;
    for (const PolygonVertices& polygon : partition.polygons) sum += area(polygon);
    double expected = 0;
    for (const Triangle& t : soup.triangles)
        expected +=
            area({soup.positions[t.vertex[0]], soup.positions[t.vertex[1]], soup.positions[t.vertex[2]]});
    EXPECT_NEAR(sum, expected, 1e-6);
}

TEST(PolygonMerge, LargeRegionsTakeLinearTime) {
    // Quadratic algorithms take minutes here.
    Soup soup = grid(500, 400);
    EXPECT_EQ(polygons_of(soup).size(), 1u);
    soup.triangles.pop_back(); // neither a rectangle nor convex with few corners
    const auto partition = merge_coplanar_triangles(soup.positions, soup.triangles);
    EXPECT_LT(partition.polygons.size(), soup.triangles.size() / 50);
    expect_partition(soup, partition);
}

TEST(CollinearVertices, AreRemoved) {
    const auto corners = without_collinear_vertices(
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
    ASSERT_EQ(corners.size(), 4u);
    EXPECT_EQ(corners[0].x, 0);
    EXPECT_EQ(corners[1].x, 2);
    EXPECT_EQ(corners[2].y, 2);
    // The first vertex may be collinear, too.
    EXPECT_EQ(without_collinear_vertices({{1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 0}}).size(), 4u);
}

} // namespace
} // namespace nusselt::scene
