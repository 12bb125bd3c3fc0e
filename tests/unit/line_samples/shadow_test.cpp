/// Tests of the shadows of triangles on lines: exact tests of points, edges that are equal bit for bit, closed
/// meshes, and scales.

#include <algorithm>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "proof/shadows/shadow_cases.h"
#include "proof/shadows/shadow_checks.h"
#include "sampling/flush_denormals.h"

namespace {

using namespace nusselt;
using hostile::RandomSource;
using shadows::in_order_of_position;
using shadows::kLinesPerCase;
using shadows::Lines;
using shadows::Occluder;
using shadows::ShadowCase;
using shadows::vector_of;

Vec3<double> exact(const Vec3<float>& v) { return {v.x, v.y, v.z}; }
Vec3<double> exact(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Whether the segment from `point` to `point + end * direction` meets the triangle.
bool blocks(const Occluder& triangle, const Vec3<double>& point, const Vec3<double>& direction, double end) {
    const Vec3<double> a = exact(triangle.corner[0]) - point;
    const Vec3<double> b = exact(triangle.corner[1]) - point;
    const Vec3<double> c = exact(triangle.corner[2]) - point;
    const Vec3<double> normal = cross(b - a, c - a);
    const double distance = dot(normal, a) / dot(normal, direction);
    if (!(distance > 0 && distance < end)) return false;
    const double x = dot(cross(b, c), direction);
    const double y = dot(cross(c, a), direction);
    const double z = dot(cross(a, b), direction);
    return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
}

Vec3<double> random_vector(RandomSource& random, double size) {
    const double x = random.between(-size, size), y = random.between(-size, size);
    return {x, y, random.between(-size, size)};
}

void store(float (&target)[3], const Vec3<double>& v) {
    target[0] = static_cast<float>(v.x);
    target[1] = static_cast<float>(v.y);
    target[2] = static_cast<float>(v.z);
}

/// A light, a point and random triangles of any size.
struct Soup : ShadowCase {
    explicit Soup(std::uint64_t index) {
        RandomSource random(5, index);
        const double size = random.log_between(0.01, 10);
        const Vec3<double> first = random_vector(random, 3);
        const Vec3<double> a = random_vector(random, size), b = random_vector(random, size);
        const Vec3<double> vertices[] = {first, first + a, first + a + 0.6 * b, first + b};
        for (int j = 0; j < 4; ++j) store(light[j], vertices[j]);
        const Vec3<double> from = random_vector(random, 3);
        store(point, from);
        storage.resize(static_cast<std::size_t>(1 + random.index(12)));
        for (Occluder& triangle : storage) {
            // Most triangles are in front of the light, some are behind it or behind the point.
            const Vec3<double> center = from +
                                        random.between(-0.2, 1.2) * (first + 0.5 * a + 0.4 * b - from) +
                                        random_vector(random, 0.5 * size);
            const double extent = size * random.log_between(0.1, 3);
            for (auto& v : triangle.corner) store(v, center + random_vector(random, extent));
            triangle = in_order_of_position(triangle);
        }
        occluders = storage.data();
        occluder_count = static_cast<int>(storage.size());
        angle = static_cast<float>(random.between(0, 3.14));
        for (int i = 0; i < kLinesPerCase; ++i) {
            u[i] = std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f);
            corner[i] = -1;
        }
    }
    Soup(const Soup&) = delete;
    Soup& operator=(const Soup&) = delete;

    std::vector<Occluder> storage;
};

constexpr LineBounds<float> kEverywhere{{-1e30f, 1e30f}, {-1e30f, 1e30f}};

/// The shadow of an occluder on a line.
template <class Real>
Interval<Real> hidden_by(const Occluder& occluder, const ShadowFrame<float>& frame, const Real& offset) {
    const Vec3<float> a = vector_of(occluder.corner[0]), b = vector_of(occluder.corner[1]),
                      c = vector_of(occluder.corner[2]);
    const TriangleShadows<float> made = make_triangle_shadow(frame, a, b, c);
    return made.partial ? hidden_interval(make_partial_shadow(frame, a, b, c), offset)
                        : shadows::hidden_from(made.shadow, offset);
}

TEST(TriangleShadow, VisibleLengthsMatchPointTests) {
    constexpr int kPoints = 100'000;
    constexpr int kCases = 12; // with 16 lines each
    int partly = 0;
    for (int index = 0; index < kCases; ++index) {
        const Soup soup(static_cast<std::uint64_t>(index));
        const shadows::CaseLines lines(soup);
        const LinePlane<float>& plane = lines.family().plane();
        const Vec3<double> point = exact(soup.point);
        Interval<Lines> storage[64];
        VisibleParts<Lines> parts(storage, 64);
        parts.reset(lines.whole());
        lines.for_each_occluder(in_order_of_position,
                                [&](const Interval<Lines>& hidden) { parts.cut(hidden); });
        for (int i = 0; i < kLinesPerCase; ++i) {
            const double begin = lines.whole().begin.lane(i);
            const double length = lines.whole().end.lane(i) - begin;
            const Vec3<double> to_line =
                exact(plane.origin) - point + double(lines.offset().lane(i)) * exact(plane.across);
            int visible_points = 0;
            for (int k = 0; k < kPoints; ++k) {
                const Vec3<double> direction =
                    to_line + (begin + length * (k + 0.5) / kPoints) * exact(plane.along);
                visible_points +=
                    std::none_of(soup.storage.begin(), soup.storage.end(), [&](const Occluder& triangle) {
                        return blocks(triangle, point, direction, kShadowEnd<double>);
                    });
            }
            double visible = 0;
            int count = 0;
            for (int k = 0; k < parts.count(); ++k)
                if (parts[k].begin.lane(i) < parts[k].end.lane(i)) {
                    visible += parts[k].end.lane(i) - parts[k].begin.lane(i);
                    ++count;
                }
            // Half a step at each end of a part, and the rounding error of positions as a share of the line.
            const double resolution = (count + 1.0) / kPoints + 5e-6 * (1 + 1 / length);
            EXPECT_NEAR(visible / length, static_cast<double>(visible_points) / kPoints, resolution)
                << "case " << index << ", line " << i;
            partly += visible_points > 0 && visible_points < kPoints;
        }
    }
    EXPECT_GT(partly, 16 * kCases / 10);
}

// The distant parts of such a floor are all projected to nearly the same place, its horizon.
TEST(TriangleShadow, FloorThroughTheLightHidesWhatIsBelowIt) {
    const Vec3<float> corners[] = {
        {-0.2f, 0.5f, 0}, {0.1f, -1, 0}, {2.3f, -1.7f, 0}, {3.4f, 0.5f, 0}, {1, 1.6f, 0}};
    const auto light = make_polygon<8>(corners, 5);
    const Vec3<float> floor[] = {{-6, 0, -6}, {-6, 0, 6}, {6, 0, -6}, {6, 0, 6}};
    constexpr int kOffsets = 200;
    int cases = 0;
    for (const float distance : {0.001f, 0.01f, 0.1f, 1.0f})
        for (const float angle : {0.0f, 0.7f, 1.5f, 2.5f}) {
            const LineFamily<float, 8> family(light, angle);
            const Vec3<float> point{1.37f, 1e-4f, distance};
            const ShadowFrame<float> frame = make_shadow_frame(family.plane(), point);
            for (int i = 0; i < kOffsets; ++i) {
                const float closest = dot(point - family.plane().origin, family.plane().across);
                const float offset = closest + 0.1f * distance * (float(i) - 0.5f * kOffsets);
                const Interval<float> extent = family.chord(offset).extent;
                for (const float share :
                     {-20.0f, -5.0f, -1.0f, -0.3f, -0.1f, 0.1f, 0.3f, 1.0f, 5.0f, 20.0f}) {
                    const float t =
                        dot(point - family.plane().origin, family.plane().along) + share * distance;
                    if (t < extent.begin || t > extent.end) continue;
                    const Vec3<float> p =
                        family.plane().origin + offset * family.plane().across + t * family.plane().along;
                    if (std::abs(p.y) < 1e-4f * distance) continue;
                    bool is_hidden = false;
                    for (int triangle = 0; triangle < 2; ++triangle) {
                        const Occluder occluder{{{floor[triangle].x, 0, floor[triangle].z},
                                                 {floor[triangle + 1].x, 0, floor[triangle + 1].z},
                                                 {floor[triangle + 2].x, 0, floor[triangle + 2].z}}};
                        const Interval<float> hidden = hidden_by(occluder, frame, offset);
                        is_hidden |= hidden.begin <= t && t <= hidden.end;
                    }
                    EXPECT_EQ(is_hidden, p.y < 0)
                        << distance << " m, angle " << angle << ", " << p.x << " " << p.y;
                    ++cases;
                }
            }
        }
    EXPECT_GT(cases, 5000);
}

TEST(TriangleShadow, ClosedMeshesDoNotLeak) {
    constexpr int kCases = 100'000 / kLinesPerCase;
    std::vector<Occluder> storage;
    for (std::uint64_t index = 0; index < kCases; ++index)
        ASSERT_EQ(shadows::leak(shadows::make_leak_case(1, index, storage)), nullptr) << index;
}

TEST(TriangleShadow, MutantsLeak) {
    constexpr int kCases = 300;
    std::vector<Occluder> storage;
    int by_winding = 0, shrunk = 0;
    for (std::uint64_t index = 0; index < kCases; ++index) {
        const ShadowCase test = shadows::make_leak_case(1, index, storage);
        by_winding += shadows::count_leaks(
            test, [](const Occluder& triangle) { return triangle; }, [](const auto& part) { return part; });
        shrunk += shadows::count_leaks(test, in_order_of_position, [](const Interval<Lines>& part) {
            const Lines margin = Lines(1e-7f) * (part.end - part.begin);
            return Interval<Lines>{part.begin + margin, part.end - margin};
        });
    }
    EXPECT_GT(by_winding, kCases * kLinesPerCase / 100);
    EXPECT_GT(shrunk, kCases * kLinesPerCase / 10);
}

// for_each_shadow makes whole shadows in packs and partial shadows one by one.
TEST(TriangleShadow, PacksHaveTheBitsOfScalars) {
    for (std::uint64_t index = 0; index < 300; ++index) {
        const Soup soup(index);
        const ShadowFrame<float> frame = shadows::CaseLines(soup).frame();
        std::vector<TriangleShadow<float>> expected;
        int partial = 0;
        for (const Occluder& t : soup.storage) {
            const TriangleShadows<float> made = make_triangle_shadow(
                frame, vector_of(t.corner[0]), vector_of(t.corner[1]), vector_of(t.corner[2]));
            partial += made.partial;
            if (!made.partial && may_hide(made.shadow, kEverywhere)) expected.push_back(made.shadow);
        }
        std::size_t k = 0;
        shadows::for_each_shadow<8>(
            frame, soup.occluders, soup.occluder_count, kEverywhere, in_order_of_position,
            [&](const auto& shadow) {
                if constexpr (std::is_same_v<decltype(shadow), const TriangleShadow<float>&>) {
                    ASSERT_LT(k, expected.size());
                    EXPECT_EQ(std::memcmp(&shadow, &expected[k++], sizeof shadow), 0) << index;
                } else {
                    --partial;
                }
            });
        EXPECT_EQ(k, expected.size());
        EXPECT_EQ(partial, 0);
    }
}

// Two triangles of a quadrilateral meet at the diagonal: the shadow of one ends where that of the other starts.
TEST(TriangleShadow, SharedEdgesAreTheSameForBothTriangles) {
    int shared = 0;
    for (std::uint64_t index = 0; index < 20'000; ++index) {
        RandomSource random(6, index);
        const Soup soup(index);
        const shadows::CaseLines lines(soup);
        const float offset = lines.offset().lane(0);
        const Vec3<double> center = exact(soup.occluders[0].corner[0]);
        const double size = random.log_between(1e-3, 10);
        float v[4][3];
        for (auto& corner : v) store(corner, center + random_vector(random, size));
        // The winding and the first corner may differ, because the triangles of meshes with split vertices share
        // positions only.
        Interval<float> hidden[2];
        for (int i = 0; i < 2; ++i) {
            int order[] = {0, i + 1, i + 2};
            std::rotate(order, order + random.index(3), order + 3);
            if (random.index(2) == 0) std::swap(order[0], order[1]);
            Occluder triangle;
            for (int k = 0; k < 3; ++k) std::copy_n(v[order[k]], 3, triangle.corner[k]);
            hidden[i] = hidden_by(in_order_of_position(triangle), lines.frame(), offset);
        }
        if (!(hidden[0].begin < hidden[0].end && hidden[1].begin < hidden[1].end)) continue;
        // Whether the diagonal casts its shadow on the line, away from the corners.
        const LinePlane<float>& plane = lines.family().plane();
        const Vec3<double> point = exact(soup.point);
        const Vec3<double> to_light = exact(plane.origin) - point;
        const Vec3<double> normal =
            cross(exact(plane.along), to_light + double(offset) * exact(plane.across));
        const Vec3<double> p = exact(v[0]) - point, q = exact(v[2]) - point;
        const double share = dot(normal, p) / (dot(normal, p) - dot(normal, q));
        const double way = dot(p + share * (q - p), exact(plane.normal)) / dot(to_light, exact(plane.normal));
        if (!(share > 1e-3 && share < 0.999 && way > 1e-3 && way < 0.999)) continue;
        ++shared;
        EXPECT_TRUE(hidden[0].begin == hidden[1].begin || hidden[0].begin == hidden[1].end ||
                    hidden[0].end == hidden[1].begin || hidden[0].end == hidden[1].end)
            << index;
    }
    EXPECT_GT(shared, 100);
}

TEST(TriangleShadow, PowersOfTwoScaleEveryBit) {
    for (const float scale : {0x1p-20f, 0x1p-10f, 0x1p10f, 0x1p20f})
        for (std::uint64_t index = 0; index < 200; ++index) {
            const Soup soup(index);
            ShadowCase scaled = soup;
            std::vector<Occluder> scaled_occluders = soup.storage;
            scaled.occluders = scaled_occluders.data();
            for (float& x : scaled.point) x *= scale;
            for (auto& vertex : scaled.light)
                for (float& x : vertex) x *= scale;
            for (Occluder& triangle : scaled_occluders)
                for (auto& corner : triangle.corner)
                    for (float& x : corner) x *= scale;
            const shadows::CaseLines lines(soup), scaled_lines(scaled);
            ASSERT_TRUE(all(scaled_lines.offset() == Lines(scale) * lines.offset()));
            for (std::size_t i = 0; i < scaled_occluders.size(); ++i) {
                const Interval<Lines> expected = hidden_by(soup.storage[i], lines.frame(), lines.offset());
                const Interval<Lines> actual =
                    hidden_by(scaled_occluders[i], scaled_lines.frame(), scaled_lines.offset());
                EXPECT_TRUE(all((actual.begin == Lines(scale) * expected.begin) &
                                (actual.end == Lines(scale) * expected.end)))
                    << index << " at " << scale;
            }
        }
}

TEST(TriangleShadow, CullingMissesNoLine) {
    int culled = 0;
    for (std::uint64_t index = 0; index < 3000; ++index) {
        const Soup soup(index);
        RandomSource random(8, index);
        const shadows::CaseLines lines(soup);
        const Interval<float> offsets = lines.family().offsets();
        const float size = offsets.end - offsets.begin;
        const auto interval = [&] {
            const auto begin = static_cast<float>(size * random.between(-1, 1));
            return Interval<float>{begin, begin + static_cast<float>(size * random.log_between(0.01, 1))};
        };
        const LineBounds<float> bounds{interval(), interval()};
        for (const Occluder& t : soup.storage) {
            const TriangleShadow<float> shadow =
                make_triangle_shadow(lines.frame(), vector_of(t.corner[0]), vector_of(t.corner[1]),
                                     vector_of(t.corner[2]))
                    .shadow;
            const bool may = may_hide(shadow, bounds);
            culled += !may;
            for (int i = 0; i <= 100; ++i) {
                const float step =
                    0.01f * static_cast<float>(i) * (bounds.offsets.end - bounds.offsets.begin);
                const float offset = std::min(bounds.offsets.begin + step, bounds.offsets.end);
                const Interval<float> hidden = hidden_interval(shadow, offset);
                const bool hides = hidden.begin < hidden.end && hidden.begin < bounds.extent.end &&
                                   hidden.end > bounds.extent.begin;
                EXPECT_TRUE(may || !hides) << index;
            }
        }
    }
    EXPECT_GT(culled, 1000);
}

void expect_no_violation(std::uint64_t seed) {
    constexpr int kCases = 100'000 / kLinesPerCase;
    std::vector<Occluder> storage;
    double sum = 0;
    for (std::uint64_t index = 0; index < kCases; ++index) {
        float visible[kLinesPerCase];
        ASSERT_EQ(shadows::broken_parts(shadows::make_hostile_case(seed, index, storage), visible), nullptr)
            << index;
        for (const float x : visible) sum += double(x);
    }
    // The test would be worthless if everything were visible, or nothing.
    EXPECT_GT(sum, 0.1 * kCases * kLinesPerCase);
    EXPECT_LT(sum, 0.9 * kCases * kLinesPerCase);
}

TEST(TriangleShadow, HostileOccludersAddNoLight) { expect_no_violation(1); }

TEST(TriangleShadow, HostileOccludersAddNoLightWithDenormalsFlushed) {
    const nusselt_test::FlushDenormalsToZero flush;
    expect_no_violation(2);
}

} // namespace
