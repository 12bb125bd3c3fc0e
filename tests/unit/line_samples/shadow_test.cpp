/// What triangles hide of lines: exact tests of points, bit-identical edges, closed meshes, scales.

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "experiments/shadows/hostile_occluders.h"
#include "experiments/shadows/leaks.h"
#include "sampling/flush_denormals.h"

namespace {

using namespace nusselt;
using hostile::RandomSource;
using shadows::in_order_of_position;
using shadows::kLinesPerCase;
using shadows::Lines;
using Triangle = shadows::Triangle<float>;

Vec3<double> exact(const Vec3<float>& v) { return {v.x, v.y, v.z}; }

/// Whether the triangle is met on the way from the point, within this share of the direction.
bool blocks(const Triangle& triangle, const Vec3<double>& point, const Vec3<double>& direction, double end) {
    const Vec3<double> a = exact(triangle[0]) - point;
    const Vec3<double> b = exact(triangle[1]) - point;
    const Vec3<double> c = exact(triangle[2]) - point;
    const Vec3<double> normal = cross(b - a, c - a);
    const double distance = dot(normal, a) / dot(normal, direction);
    if (!(distance > 0 && distance < end)) return false;
    const double x = dot(cross(b, c), direction);
    const double y = dot(cross(c, a), direction);
    const double z = dot(cross(a, b), direction);
    return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
}

Vec3<float> random_vector(RandomSource& random, double size) {
    const auto coordinate = [&] { return static_cast<float>(size * random.between(-1, 1)); };
    const float x = coordinate(), y = coordinate();
    return {x, y, coordinate()};
}

/// A light, a point and triangles of any size all around.
struct Soup {
    ConvexPolygon<float, 4> light;
    Vec3<float> point;
    std::vector<Triangle> triangles;
    float angle;
    float u[kLinesPerCase];

    explicit Soup(std::uint64_t index) {
        RandomSource random(5, index);
        const double size = random.log_between(0.01, 10);
        const Vec3<float> corner = random_vector(random, 3);
        const Vec3<float> a = random_vector(random, size);
        const Vec3<float> b = random_vector(random, size);
        const Vec3<float> vertices[] = {corner, corner + a, corner + a + 0.6f * b, corner + b};
        light = make_polygon<4>(vertices, 4);
        point = random_vector(random, 3);
        const int count = 1 + random.index(12);
        for (int i = 0; i < count; ++i) {
            // Mostly before the light, also behind it and behind the point.
            const auto way = static_cast<float>(random.between(-0.2, 1.2));
            const double extent = size * random.log_between(0.1, 3);
            const Vec3<float> center = fma(way, light.vertex[0] + 0.5f * (a + 0.8f * b) - point, point) +
                                       random_vector(random, 0.5 * size);
            triangles.push_back(in_order_of_position<float>({center + random_vector(random, extent),
                                                             center + random_vector(random, extent),
                                                             center + random_vector(random, extent)}));
        }
        angle = static_cast<float>(random.between(0, 3.14));
        for (float& x : u) x = std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f);
    }

    LineFamily<float, 4> family() const { return {light, angle}; }
};

constexpr LineBounds<float> kEverywhere{{-1e30f, 1e30f}, {-1e30f, 1e30f}};

// The visible length of a line lies between those of the points that are visible for sure and those that may be.
TEST(TriangleShadow, VisibleLengthsMatchPointTests) {
    constexpr int kPoints = 100'000;
    constexpr int kCases = 12; // with 16 lines each
    int partly = 0;
    for (int index = 0; index < kCases; ++index) {
        const Soup soup(static_cast<std::uint64_t>(index));
        const LineFamily<float, 4> family = soup.family();
        const LinePlane<float>& plane = family.plane();
        const Lines offset = LineFamily<Lines, 4>(family).sample_uniform(Lines::load(soup.u)).offset;
        const Interval<Lines> whole = LineFamily<Lines, 4>(family).chord(offset).extent;
        Interval<Lines> storage[64];
        VisibleParts<Lines> parts(storage, 64);
        parts.reset(whole);
        shadows::for_each_shadow<8>(
            make_shadow_frame(plane, soup.point), soup.triangles, kEverywhere,
            [&](const auto& shadow) { parts.cut(shadows::hidden_from(shadow, offset)); });
        for (int i = 0; i < kLinesPerCase; ++i) {
            const double begin = whole.begin.lane(i);
            const double length = whole.end.lane(i) - begin;
            int visible_points = 0;
            for (int k = 0; k < kPoints; ++k) {
                const double t = begin + length * (k + 0.5) / kPoints;
                const Vec3<double> p = exact(plane.origin) + double(offset.lane(i)) * exact(plane.across) +
                                       t * exact(plane.along);
                const Vec3<double> direction = p - exact(soup.point);
                visible_points +=
                    std::none_of(soup.triangles.begin(), soup.triangles.end(), [&](const Triangle& triangle) {
                        return blocks(triangle, exact(soup.point), direction, kShadowEnd<double>);
                    });
            }
            double visible = 0;
            int count = 0;
            for (int k = 0; k < parts.count(); ++k)
                if (parts[k].begin.lane(i) < parts[k].end.lane(i)) {
                    visible += parts[k].end.lane(i) - parts[k].begin.lane(i);
                    ++count;
                }
            // Half a step at each end of a part, and the rounding of positions as a share of the line.
            const double resolution = (count + 1.0) / kPoints + 5e-6 * (1 + 1 / length);
            EXPECT_NEAR(visible / length, static_cast<double>(visible_points) / kPoints, resolution)
                << "case " << index << ", line " << i;
            partly += visible_points > 0 && visible_points < kPoints;
        }
    }
    EXPECT_GT(partly, 16 * kCases / 10);
}

TEST(TriangleShadow, ClosedMeshesDoNotLeak) {
    constexpr int kCases = 100'000 / kLinesPerCase;
    int leaks = 0, visible = 0;
    for (int index = 0; index < kCases; ++index) {
        const shadows::LeakCase test = shadows::make_leak_case(1, static_cast<std::uint64_t>(index));
        leaks += count_leaks(test, in_order_of_position<float>, [](const auto& part) { return part; });
        visible += count_visible(test);
    }
    EXPECT_EQ(leaks, 0);
    EXPECT_EQ(visible, 0);
}

TEST(TriangleShadow, MutantsLeak) {
    constexpr int kCases = 300;
    int by_winding = 0, shrunk = 0;
    for (int index = 0; index < kCases; ++index) {
        const shadows::LeakCase test = shadows::make_leak_case(1, static_cast<std::uint64_t>(index));
        by_winding += count_leaks(
            test, [](const Triangle& triangle) { return triangle; }, [](const auto& part) { return part; });
        shrunk += count_leaks(test, in_order_of_position<float>, [](const Interval<Lines>& part) {
            const Lines margin = Lines(1e-7f) * (part.end - part.begin);
            return Interval<Lines>{part.begin + margin, part.end - margin};
        });
    }
    EXPECT_GT(by_winding, kCases * kLinesPerCase / 100);
    EXPECT_GT(shrunk, kCases * kLinesPerCase / 10);
}

/// All numbers of a shadow, to be compared bit by bit.
template <class Shadow>
bool same_bits(const Shadow& a, const Shadow& b) {
    static_assert(sizeof(Shadow) % sizeof(float) == 0);
    return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(TriangleShadow, PacksHaveTheBitsOfScalars) {
    for (std::uint64_t index = 0; index < 300; ++index) {
        const Soup soup(index);
        const ShadowFrame<float> frame = make_shadow_frame(soup.family().plane(), soup.point);
        std::vector<TriangleShadow<float>> expected;
        int partial = 0;
        for (const Triangle& t : soup.triangles) {
            const TriangleShadows<float> made = make_triangle_shadow(frame, t[0], t[1], t[2]);
            if (made.partial)
                ++partial;
            else if (may_hide(made.shadow, kEverywhere))
                expected.push_back(made.shadow);
        }
        std::size_t k = 0;
        shadows::for_each_shadow<8>(frame, soup.triangles, kEverywhere, [&](const auto& shadow) {
            if constexpr (std::is_same_v<decltype(shadow), const TriangleShadow<float>&>) {
                ASSERT_LT(k, expected.size());
                EXPECT_TRUE(same_bits(shadow, expected[k++])) << index;
            } else {
                --partial;
            }
        });
        EXPECT_EQ(k, expected.size());
        EXPECT_EQ(partial, 0);
    }
}

// Two triangles of a quadrilateral meet in the diagonal: one ends where the other begins.
TEST(TriangleShadow, SharedEdgesAreTheSameForBothTriangles) {
    int shared = 0;
    for (std::uint64_t index = 0; index < 20'000; ++index) {
        RandomSource random(6, index);
        const Soup soup(index);
        const LineFamily<float, 4> family = soup.family();
        const ShadowFrame<float> frame = make_shadow_frame(family.plane(), soup.point);
        const double size = random.log_between(1e-3, 10);
        const Vec3<float> center = random_vector(random, 3);
        Vec3<float> v[4];
        for (Vec3<float>& corner : v) corner = center + random_vector(random, size);
        // Any winding and any first corner: meshes with split vertices have nothing in common but positions.
        Triangle triangles[] = {{v[0], v[1], v[2]}, {v[0], v[2], v[3]}};
        for (Triangle& triangle : triangles) {
            std::rotate(triangle.begin(), triangle.begin() + random.index(3), triangle.end());
            if (random.index(2) == 0) std::swap(triangle[0], triangle[1]);
            triangle = in_order_of_position(triangle);
        }
        const float offset = family.sample_uniform(soup.u[0]).offset;
        Interval<float> hidden[2];
        for (int i = 0; i < 2; ++i) {
            const Triangle& t = triangles[i];
            const TriangleShadows<float> made = make_triangle_shadow(frame, t[0], t[1], t[2]);
            hidden[i] = made.partial ? hidden_interval(make_partial_shadow(frame, t[0], t[1], t[2]), offset)
                                     : hidden_interval(made.shadow, offset);
        }
        if (!(hidden[0].begin < hidden[0].end && hidden[1].begin < hidden[1].end)) continue;
        // Whether the line meets the diagonal between point and light, and not near a corner.
        const bool crosses_diagonal = [&] {
            const LinePlane<float>& plane = family.plane();
            const Vec3<double> to_light = exact(plane.origin) - exact(soup.point);
            const Vec3<double> normal =
                cross(exact(plane.along), to_light + double(offset) * exact(plane.across));
            const Vec3<double> p = exact(v[0]) - exact(soup.point), q = exact(v[2]) - exact(soup.point);
            const double share = dot(normal, p) / (dot(normal, p) - dot(normal, q));
            const Vec3<double> crossing = p + share * (q - p);
            const double way = dot(crossing, exact(plane.normal)) / dot(to_light, exact(plane.normal));
            return share > 1e-3 && share < 0.999 && way > 1e-3 && way < 0.999;
        }();
        if (!crosses_diagonal) continue;
        ++shared;
        EXPECT_TRUE(hidden[0].begin == hidden[1].begin || hidden[0].begin == hidden[1].end ||
                    hidden[0].end == hidden[1].begin || hidden[0].end == hidden[1].end)
            << index;
    }
    EXPECT_GT(shared, 100);
}

TEST(TriangleShadow, PowersOfTwoScaleEveryBit) {
    for (const float scale : {0x1p-40f, 0x1p-10f, 0x1p10f, 0x1p40f})
        for (std::uint64_t index = 0; index < 200; ++index) {
            const Soup soup(index);
            Soup scaled = soup;
            Vec3<float> vertices[4];
            for (int j = 0; j < 4; ++j) vertices[j] = scale * soup.light.vertex[j];
            scaled.light = make_polygon<4>(vertices, 4);
            const LineFamily<float, 4> family = soup.family(), scaled_family = scaled.family();
            const Lines u = Lines::load(soup.u);
            const Lines offset = LineFamily<Lines, 4>(family).sample_uniform(u).offset;
            const Lines scaled_offset = LineFamily<Lines, 4>(scaled_family).sample_uniform(u).offset;
            ASSERT_TRUE(all(scaled_offset == Lines(scale) * offset));
            const ShadowFrame<float> frame = make_shadow_frame(family.plane(), soup.point);
            const ShadowFrame<float> scaled_frame =
                make_shadow_frame(scaled_family.plane(), scale * soup.point);
            for (const Triangle& t : soup.triangles) {
                const auto hidden = [](const ShadowFrame<float>& seen, const Triangle& triangle,
                                       const Lines& at) {
                    const auto made = make_triangle_shadow(seen, triangle[0], triangle[1], triangle[2]);
                    return made.partial
                               ? hidden_interval(
                                     make_partial_shadow(seen, triangle[0], triangle[1], triangle[2]), at)
                               : hidden_interval(broadcast<Lines>(made.shadow), at);
                };
                const Interval<Lines> expected = hidden(frame, t, offset);
                const Interval<Lines> actual =
                    hidden(scaled_frame, {scale * t[0], scale * t[1], scale * t[2]}, scaled_offset);
                EXPECT_TRUE(all((actual.begin == Lines(scale) * expected.begin) &
                                (actual.end == Lines(scale) * expected.end)))
                    << index << " at " << scale;
            }
        }
}

TEST(TriangleShadow, CullingMissesNoLine) {
    int culled = 0, all_hidden = 0;
    for (std::uint64_t index = 0; index < 3000; ++index) {
        const Soup soup(index);
        RandomSource random(8, index);
        const ShadowFrame<float> frame = make_shadow_frame(soup.family().plane(), soup.point);
        const auto interval = [&](double size) {
            const auto begin = static_cast<float>(random.between(-1, 1));
            return Interval<float>{begin, begin + static_cast<float>(random.log_between(0.01, size))};
        };
        const LineBounds<float> bounds{interval(1), interval(1)};
        for (const Triangle& t : soup.triangles) {
            const TriangleShadow<float> shadow = make_triangle_shadow(frame, t[0], t[1], t[2]).shadow;
            const bool may = may_hide(shadow, bounds);
            const bool everything = hides_all(shadow, bounds);
            culled += !may;
            all_hidden += everything;
            for (int i = 0; i <= 100; ++i) {
                const float offset =
                    std::min(bounds.offsets.begin +
                                 0.01f * static_cast<float>(i) * (bounds.offsets.end - bounds.offsets.begin),
                             bounds.offsets.end);
                const Interval<float> hidden = hidden_interval(shadow, offset);
                const bool hides = hidden.begin < hidden.end && hidden.begin < bounds.extent.end &&
                                   hidden.end > bounds.extent.begin;
                EXPECT_TRUE(may || !hides) << index;
                if (!everything) continue;
                // The corner may be off by its rounding.
                EXPECT_LE(hidden.begin, bounds.extent.begin + 1e-5f) << index;
                EXPECT_GE(hidden.end, bounds.extent.end - 1e-5f) << index;
            }
        }
    }
    EXPECT_GT(culled, 1000);
    EXPECT_GT(all_hidden, 30);
}

void expect_no_violation(std::uint64_t seed) {
    constexpr int kCases = 100'000 / kLinesPerCase;
    int failures = 0;
    double visible = 0;
    for (int index = 0; index < kCases && failures < 5; ++index) {
        const auto test = shadows::make_hostile_case(seed, static_cast<std::uint64_t>(index));
        if (const char* problem = violation(test, visible)) {
            ADD_FAILURE() << "index " << index << ": " << problem;
            ++failures;
        }
    }
    // The generator is of no use if everything is visible, or nothing.
    EXPECT_GT(visible, 0.1 * kCases * kLinesPerCase);
    EXPECT_LT(visible, 0.9 * kCases * kLinesPerCase);
}

TEST(TriangleShadow, HostileOccludersAddNoLight) { expect_no_violation(1); }

TEST(TriangleShadow, HostileOccludersAddNoLightWithDenormalsFlushed) {
    const nusselt_test::FlushDenormalsToZero flush;
    expect_no_violation(2);
}

} // namespace
