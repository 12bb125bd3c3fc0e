/// Tests of the splitting of outlines into convex polygons.

#include <nusselt/geometry/split_convex.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/geometry/polygon_measures.h>

namespace nusselt_test {
namespace {

using nusselt::Vec2;
using nusselt::Vec3;
using Outline = std::vector<Vec2<double>>;

/// A plane: its points are origin + x * u + y * v.
struct Plane {
    Vec3<double> origin, u, v;
};

/// Axis-aligned and oblique ones.
const Plane kPlanes[] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                         {{3, -2, 1}, {0, 1, 0}, {0, 0, 1}},
                         {{-1, 4, 2}, {0, 0, 1}, {1, 0, 0}},
                         {{3, -2, 1}, {0.6, 0.8, 0}, {-0.48, 0.36, 0.8}}};

template <class T>
std::vector<Vec3<T>> in_plane(const Outline& outline, const Plane& plane) {
    std::vector<Vec3<T>> vertices;
    for (const auto& p : outline)
        vertices.push_back(nusselt::broadcast<T>(plane.origin + p.x * plane.u + p.y * plane.v));
    return vertices;
}

double doubled_area(const Outline& outline) {
    double sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        sum += det(outline[i], outline[(i + 1) % outline.size()]);
    return sum;
}

bool is_inside(const Outline& outline, const Vec2<double>& p) {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto& a = outline[i];
        const auto& b = outline[(i + 1) % outline.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

/// All outlines are counter-clockwise.
Outline star(int corners, std::mt19937& random) {
    std::uniform_real_distribution<double> radius(0.05, 1);
    Outline outline;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * nusselt::kPi<double> * i / corners;
        const double r = radius(random);
        outline.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return outline;
}
const Outline kComb = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                       {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
const Outline kSpiral = {{0, 0}, {6, 0}, {6, 6}, {1, 6}, {1, 2}, {4, 2}, {4, 4},
                         {3, 4}, {3, 3}, {2, 3}, {2, 5}, {5, 5}, {5, 1}, {0, 1}};
/// A square with a square hole; the outline goes to the hole and back along the same line.
const Outline kFrame = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};

template <class T>
class SplitConvexTest : public ::testing::Test {
protected:
    static constexpr double kEpsilon = std::max(static_cast<double>(std::numeric_limits<T>::epsilon()),
                                                std::numeric_limits<double>::epsilon());

    /// Parts are convex with the winding of the outline, and each point of the outline is in exactly one of them.
    template <int N>
    void expect_partition(Outline outline, const Plane& plane, std::size_t most_parts) {
        for (const bool reversed : {false, true}) {
            if (reversed) std::reverse(outline.begin(), outline.end());
            const auto vertices = in_plane<T>(outline, plane);
            const auto parts = nusselt::split_convex<N>(vertices.data(), vertices.size());
            EXPECT_LE(parts.size(), most_parts);
            const auto normal = (reversed ? -1.0 : 1.0) * cross(plane.u, plane.v);
            std::vector<Outline> flat;
            double sum = 0;
            for (const auto& part : parts) {
                EXPECT_GT(dot(nusselt::broadcast<double>(part.normal), normal), 1 - 16 * kEpsilon);
                flat.push_back(flattened(part, plane));
                sum += std::fabs(doubled_area(flat.back()));
                expect_convex(flat.back(), reversed);
            }
            EXPECT_NEAR(sum, std::fabs(doubled_area(outline)), 1e3 * kEpsilon);
            std::mt19937 random(3);
            std::uniform_real_distribution<double> anywhere(-1.1, 6.1);
            for (int i = 0; i < 300; ++i) {
                const Vec2<double> p{anywhere(random), anywhere(random)};
                const auto holding = std::count_if(flat.begin(), flat.end(),
                                                   [&](const Outline& part) { return is_inside(part, p); });
                EXPECT_EQ(holding, is_inside(outline, p) ? 1 : 0) << p.x << " " << p.y;
            }
        }
    }

private:
    template <int N>
    static Outline flattened(const nusselt::ConvexPolygon<T, N>& part, const Plane& plane) {
        Outline result;
        for (const auto& v : part.vertex) {
            const auto offset = nusselt::broadcast<double>(v) - plane.origin;
            result.push_back({dot(offset, plane.u), dot(offset, plane.v)});
        }
        return result;
    }
    static void expect_convex(const Outline& part, bool reversed) {
        const std::size_t n = part.size();
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                const double left = det(part[(i + 1) % n] - part[i], part[j] - part[i]);
                EXPECT_GE(reversed ? -left : left, -200 * kEpsilon);
            }
    }
};

using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(SplitConvexTest, Scalars);

TYPED_TEST(SplitConvexTest, CombsSpiralsAndFramesInAllPlanes) {
    for (const Plane& plane : kPlanes) {
        for (Outline outline : {kComb, kSpiral, kFrame}) {
            for (std::size_t first = 0; first < outline.size(); ++first) {
                std::rotate(outline.begin(), outline.begin() + 1, outline.end());
                this->template expect_partition<3>(outline, plane, outline.size() - 2);
                this->template expect_partition<4>(outline, plane, outline.size() - 5);
                this->template expect_partition<8>(outline, plane, outline.size() - 5);
            }
        }
    }
}

TYPED_TEST(SplitConvexTest, Stars) {
    std::mt19937 random(5);
    for (int corners = 4; corners < 40; ++corners)
        this->template expect_partition<5>(star(corners, random), kPlanes[0],
                                           static_cast<std::size_t>(corners - 2));
}

TYPED_TEST(SplitConvexTest, ConvexOutlinesStayWhole) {
    const Outline hexagon = {{0, 0}, {2, -1}, {4, 0}, {4, 2}, {2, 3}, {0, 2}};
    // Repeated vertices, and others on straight sides.
    const Outline square = {{0, 0}, {0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    for (const Plane& plane : kPlanes) {
        this->template expect_partition<6>(hexagon, plane, 1);
        this->template expect_partition<8>(hexagon, plane, 1);
        this->template expect_partition<4>(hexagon, plane, 2);
        this->template expect_partition<4>(square, plane, 1);
    }
}

TYPED_TEST(SplitConvexTest, AnLIsTwoQuadrilaterals) {
    const Outline corner = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (const Plane& plane : kPlanes) this->template expect_partition<4>(corner, plane, 2);
}

/// What lights from split outlines add up to: the measures of the parts.
TEST(SplitConvexMeasureTest, PartsOfASquareWithAHoleSeeWhatTheSquareSeesWithoutTheHole) {
    const auto measure = [](const Outline& outline) {
        const auto vertices = in_plane<double>(outline, {{-1, -2, 1.5}, {1, 0, 0}, {0, 0.8, 0.6}});
        double sum = 0;
        for (const auto& part : nusselt::split_convex<5>(vertices.data(), vertices.size()))
            sum += projected_solid_angle(part);
        return sum;
    };
    const Outline whole(kFrame.begin(), kFrame.begin() + 4), hole(kFrame.begin() + 5, kFrame.begin() + 9);
    EXPECT_NEAR(measure(kFrame), measure(whole) - measure(hole), 1e-12);
    EXPECT_GT(measure(hole), 0.1);
}

TEST(TriangulateTest, ConvexOutlinesAreFansAndOthersAreNot) {
    const auto convex = in_plane<float>({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}}, kPlanes[1]);
    EXPECT_TRUE(nusselt::is_strictly_convex(convex.data(), convex.size()));
    const std::vector<nusselt::OutlineTriangle> fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    EXPECT_EQ(nusselt::triangulate(convex.data(), convex.size()), fan);
    const auto comb = in_plane<float>(kComb, kPlanes[1]);
    EXPECT_FALSE(nusselt::is_strictly_convex(comb.data(), comb.size()));
    EXPECT_EQ(nusselt::triangulate(comb.data(), comb.size()).size(), comb.size() - 2);
}

template <class T>
std::size_t count_parts(const std::vector<Vec3<T>>& vertices) {
    const auto parts = nusselt::split_convex<4>(vertices.data(), vertices.size());
    for (const auto& part : parts) EXPECT_GT(area(part), 0);
    return parts.size();
}

TYPED_TEST(SplitConvexTest, OutlinesWithoutAreaHaveNoParts) {
    using T = TypeParam;
    const T nan = std::numeric_limits<T>::quiet_NaN();
    EXPECT_EQ(count_parts<T>({}), 0u);
    EXPECT_EQ(count_parts<T>({{1, 2, 3}}), 0u);
    EXPECT_EQ(count_parts<T>({{1, 2, 3}, {2, 2, 3}}), 0u);
    EXPECT_EQ(count_parts<T>({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), 0u);
    EXPECT_EQ(count_parts<T>({{1, 1, 1}, {2, 2, 2}, {4, 4, 4}, {3, 3, 3}}), 0u);
    EXPECT_EQ(count_parts<T>({{nan, nan, nan}, {nan, 1, 0}, {1, nan, 0}, {0, 1, nan}}), 0u);
}

/// There is nothing to expect but an end, and parts with an area.
TYPED_TEST(SplitConvexTest, OutlinesThatMakeNoSenseEnd) {
    using T = TypeParam;
    const T infinity = std::numeric_limits<T>::infinity();
    count_parts<T>({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}); // a bow tie
    count_parts<T>({{0, 0, 0}, {infinity, 0, 0}, {1, 1, 0}, {0, -infinity, 0}});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    for (const double scale : {1.0, 1e-30, 1e15}) {
        std::vector<Vec3<T>> tangle(100);
        for (auto& p : tangle) {
            const double x = anywhere(random), y = anywhere(random), z = anywhere(random);
            p = nusselt::broadcast<T>(Vec3<double>{scale * x, scale * y, scale * z});
        }
        EXPECT_GT(nusselt::split_convex<8>(tangle.data(), tangle.size()).size(), 0u);
    }
}

} // namespace
} // namespace nusselt_test
