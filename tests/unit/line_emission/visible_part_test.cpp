/// Parts of lines, strips and tubes that a spread lets a point see: all that shines, and little more.

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <nusselt/emission/spread.h>
#include <nusselt/line_emission/visible_part.h>

namespace nusselt_test {
namespace {

using nusselt::LineSegment;
using nusselt::RadialSpread;
using Line = LineSegment<float>;
using Vector = nusselt::Vec3<float>;
using Exact = nusselt::Vec3<double>;

Exact exact(const Vector& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

/// Lines of 0.01 m to 100 m around the origin, and slopes of spreads from 0.1 degrees on.
class Lines {
public:
    Line line() {
        const Vector start{coordinate(), coordinate(), coordinate()};
        const Vector direction{coordinate(), coordinate(), coordinate()};
        return {start, normalize(direction), std::exp(uniform_(random_) * 9.2f - 4.6f)};
    }
    float slope() { return std::tan(0.5f * std::exp(uniform_(random_) * 7.3f - 6.3f)); }
    float radius() { return 0.01f + 0.3f * uniform_(random_); }
    double share() { return double{uniform_(random_)}; }
    Vector normal_of(const Line& line) {
        return normalize(cross(line.s, Vector{coordinate(), coordinate(), coordinate()}));
    }

private:
    float coordinate() { return 6 * uniform_(random_) - 3; }

    std::mt19937 random_{5};
    std::uniform_real_distribution<float> uniform_{0, 1};
};

/// The place of a point along a line [m].
double place(const Line& line, const Exact& p) { return dot(p - exact(line.p0), exact(line.s)); }

struct Interval {
    double low, high;
};
Interval places_of(const Line& part, const Line& whole) {
    const double low = place(whole, exact(part.p0));
    return {low, low + double{part.length}};
}

/// The angle of the direction to the origin from a normal passes: its tangent is below the slope.
bool passes(const Exact& p, const Exact& normal, double slope) {
    const Exact to_origin = normalize(-p);
    const double along = std::fabs(dot(normal, to_origin));
    return along > 0 && length(to_origin - dot(to_origin, normal) * normal) < slope * along;
}

/// Whether a point of a line shines to the origin, for some normal across the line.
bool line_passes(const Line& line, const Exact& p, double slope) {
    const Exact s = exact(line.s);
    return passes(p, normalize(p - dot(p, s) * s), slope);
}

/// \param part_of  function of line, normal and slope
/// \param shines   function of line, normal, point and slope
/// \param rounding of ends for a slope of 0; the extent of lines is below 110 m
/// \returns the share of lines of which something is cut off
template <class PartOf, class Shines>
double expect_exact_parts(const PartOf& part_of, const Shines& shines, double rounding) {
    Lines lines;
    constexpr int kLines = 20000;
    int cut = 0;
    for (int k = 0; k < kLines; ++k) {
        const Line line = lines.line();
        const Vector normal = lines.normal_of(line);
        const float slope = lines.slope();
        const Line part = part_of(line, normal, slope);
        const Interval at = places_of(part, line);
        const double length = double{line.length};
        const double tolerance = rounding * (1 + double{slope});
        EXPECT_TRUE(at.low >= -1e-5 * length - 1e-6 && at.high <= length * (1 + 1e-5) + 1e-6) << k;
        const auto point = [&](double t) { return exact(line.p0) + t * exact(line.s); };
        for (int i = 0; i < 20; ++i) {
            const double t = lines.share() * length;
            const bool is_inside = t > at.low - 1e-5 && t < at.high + 1e-5;
            EXPECT_TRUE(is_inside || !shines(line, exact(normal), point(t), double{slope})) << k << " " << t;
        }
        // Both ends are those of the line, or next to where the light ends.
        if (part.length > 3 * tolerance) {
            EXPECT_TRUE(at.low < tolerance ||
                        shines(line, exact(normal), point(at.low + tolerance), double{slope}))
                << k;
            EXPECT_TRUE(at.high > length - tolerance ||
                        shines(line, exact(normal), point(at.high - tolerance), double{slope}))
                << k;
        }
        cut += at.high - at.low < 0.9 * length;
    }
    return static_cast<double>(cut) / kLines;
}

TEST(VisiblePart, OfLines) {
    const double cut = expect_exact_parts(
        [](const Line& line, const Vector&, float slope) { return visible_part(line, slope); },
        [](const Line& line, const Exact&, const Exact& p, double slope) {
            return line_passes(line, p, slope);
        },
        1e-4);
    EXPECT_GT(cut, 0.5);
    EXPECT_LT(cut, 0.99);
}

TEST(VisiblePart, OfStrips) {
    const double cut =
        expect_exact_parts([](const Line& line, const Vector& normal,
                              float slope) { return visible_part_of_strip(line, normal, slope); },
                           [](const Line&, const Exact& normal, const Exact& p, double slope) {
                               return passes(p, normal, slope);
                           },
                           // The root of a difference.
                           4e-2);
    EXPECT_GT(cut, 0.5);
    EXPECT_LT(cut, 0.99);
}

/// Points of the lateral surface and of caps that shine to the origin are on the part.
TEST(VisiblePart, OfTubes) {
    Lines lines;
    int shine = 0, cut = 0;
    for (int k = 0; k < 20000; ++k) {
        const Line axis = lines.line();
        const float radius = lines.radius();
        const float slope = lines.slope();
        const Line part = visible_part_of_tube(axis, radius, slope);
        const Interval at = places_of(part, axis);
        const double length = double{axis.length};
        ASSERT_GT(part.length, 0) << k;
        cut += double{part.length} < 0.9 * length;
        const Exact s = exact(axis.s);
        const Exact x = exact(lines.normal_of(axis));
        const Exact y = cross(s, x);
        for (int i = 0; i < 20; ++i) {
            const double turn = 2 * nusselt::kPi<double> * lines.share();
            const Exact normal = std::cos(turn) * x + std::sin(turn) * y;
            const double t = lines.share() * length;
            const Exact p = exact(axis.p0) + t * s + double{radius} * normal;
            if (!(dot(normal, -p) > 0) || !passes(p, normal, double{slope})) continue;
            ++shine;
            EXPECT_TRUE(t > at.low - 1e-5 && t < at.high + 1e-5) << k << " " << t;
        }
        // An end that the origin is beyond keeps its cap, and no face of a cut is visible.
        const double foot = place(axis, {0, 0, 0});
        const double nearest = std::clamp(foot, 0.0, length);
        EXPECT_LE(at.low, nearest + 1e-5) << k;
        EXPECT_GE(at.high, nearest - 1e-5 * (1 + length)) << k;
    }
    EXPECT_GT(shine, 1000);
    EXPECT_GT(cut, 5000);
}

TEST(VisiblePart, NothingReachesPointsBeyondTheEnds) {
    const Line line{{1, 0, 1e-3f}, {1, 0, 0}, 5};
    EXPECT_EQ(visible_part(line, 0.01f).length, 0);
    EXPECT_EQ(visible_part_of_strip(line, {0, 0, 1}, 0.01f).length, 0);
    EXPECT_EQ(visible_part_of_strip(Line{{-1, 1, 1}, {1, 0, 0}, 5}, {0, 0, 1}, 0.5f).length, 0);
    EXPECT_NEAR(visible_part_of_tube(line, 0.1f, 0.01f).length, 0.1f, 1e-3f);
    EXPECT_LT(visible_part_of_tube(Line{{-3, 0, 1}, {1, 0, 0}, 5}, 0.1f, 0.01f).length, 0.021f);
}

TEST(VisiblePart, HostileLinesHaveAPart) {
    constexpr float kNumbers[] = {0, 1e-38f, -1e-20f, 1e-6f, -1, 1e6f, 1e15f, -1e30f};
    for (const float x : kNumbers)
        for (const float z : kNumbers)
            for (const float length : {0.0f, 1e-30f, 1.0f, 1e15f, 1e34f})
                for (const float slope : {1e-4f, 1.0f, 1e4f}) {
                    const Line line{{x, 0.5f, z}, {0.6f, 0, 0.8f}, length};
                    for (const Line& part :
                         {visible_part(line, slope), visible_part_of_tube(line, 0.1f, slope),
                          visible_part_of_strip(line, {0, 1, 0}, slope)})
                        EXPECT_TRUE(part.length >= 0 && part.length <= length)
                            << x << " " << z << " " << length;
                }
}

} // namespace
} // namespace nusselt_test
