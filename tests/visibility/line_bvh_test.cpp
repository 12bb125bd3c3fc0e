/// Lines of lights against scenes: by the hierarchy as by all triangles, and as Embree's rays.

#include "line_queries.h"
#include "soups.h"

#include "visibility/embree_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nusselt::visibility_test {
namespace {

using visibility::LineBvh;

/// Orders of cuts differ: gaps that one of them finds to be rounding may remain in the other.
constexpr double kOrder = 1e-5;

LineQuery random_query(std::mt19937& random, float size = 1) {
    std::uniform_real_distribution<float> uniform(-1, 1);
    LineQuery query;
    query.point = {size * uniform(random), size * uniform(random), size * uniform(random)};
    query.angle = 1.57f * (1 + uniform(random));
    return query;
}

class LineSoup : public testing::TestWithParam<int> {
protected:
    LineSoup() : scene_(make_empty_scene()) {
        add_ceiling_light(scene_);
        add_soup(scene_, GetParam(), random_);
    }

    std::mt19937 random_{static_cast<unsigned>(GetParam())};
    scene::Scene scene_;
};

INSTANTIATE_TEST_SUITE_P(Sizes, LineSoup, testing::Values(0, 1, 7, 9, 60, 500, 4000));

TEST_P(LineSoup, HidesWhatAllTrianglesHide) {
    const LineBvh bvh(scene_);
    double shares = 0;
    for (int i = 0; i < 40; ++i) {
        const LineQuery query = random_query(random_);
        const auto expected = cut_by_all(scene_, query);
        const auto lines = trace<16>(scene_, bvh, query);
        ASSERT_TRUE(are_valid(lines));
        ASSERT_LE(difference(lines, expected), kOrder) << "query " << i;
        shares += visible_share(expected) / 40;
    }
    // The queries are conclusive: neither all nor nothing is visible.
    if (GetParam() >= 60 && GetParam() <= 500) {
        EXPECT_GT(shares, 0.01);
        EXPECT_LT(shares, 0.99);
    }
}

TEST_P(LineSoup, IsTheSameForAllWidthsOfPacks) {
    const LineBvh bvh(scene_);
    for (int i = 0; i < 20; ++i) {
        LineQuery query = random_query(random_);
        query.line_count = 1 + i * 3;
        const auto lines = trace<16>(scene_, bvh, query);
        EXPECT_LE(difference(trace<4>(scene_, bvh, query), lines), kOrder);
        EXPECT_LE(difference(trace<8>(scene_, bvh, query), lines), kOrder);
    }
}

/// Rays to points of lines, except close to the ends of visible parts.
TEST_P(LineSoup, AgreesWithRays) {
    const LineBvh bvh(scene_);
    const visibility::EmbreeScene embree(scene_);
    const auto tracer = embree.tracer();
    int tests = 0;
    int errors = 0;
    for (int i = 0; i < 60; ++i) {
        const LineQuery query = random_query(random_);
        const SeenLight seen = seen_light(scene_, query);
        const LineFamily<float, 4> family(polygon_of(scene_, query.light), query.angle);
        for (const VisibleLine& line : trace<16>(scene_, bvh, query)) {
            const float length = line.whole.extent.end - line.whole.extent.begin;
            visibility::RayPacket<16> rays{};
            float t[16];
            for (int k = 0; k < 16; ++k) {
                t[k] = line.whole.extent.begin + (static_cast<float>(k) + 0.5f) / 16 * length;
                const LinePlane<float>& plane = family.plane();
                const Vec3<float> to_light =
                    plane.origin + line.whole.offset * plane.across + t[k] * plane.along - query.point;
                rays.origin[0][k] = query.point.x;
                rays.origin[1][k] = query.point.y;
                rays.origin[2][k] = query.point.z;
                rays.direction[0][k] = to_light.x;
                rays.direction[1][k] = to_light.y;
                rays.direction[2][k] = to_light.z;
                rays.t_far[k] = kShadowEnd<float>;
            }
            const auto blocked = static_cast<const visibility::PacketTracer<16>&>(tracer).occluded(
                tracer.context, 0xffff, rays);
            for (int k = 0; k < 16; ++k) {
                bool visible = false;
                bool is_close = false;
                for (const Interval<float>& part : line.parts) {
                    visible |= part.begin <= t[k] && t[k] <= part.end;
                    is_close |= std::fabs(t[k] - part.begin) < 1e-4f * length ||
                                std::fabs(t[k] - part.end) < 1e-4f * length;
                }
                if (is_close) continue;
                ++tests;
                errors += visible == ((blocked >> k & 1u) != 0);
            }
        }
        ASSERT_TRUE(seen.is_visible());
    }
    EXPECT_GT(tests, 10000);
    // Gaps between shadows that are narrower than the distance from the ends above.
    EXPECT_LE(errors, tests / 2000);
}

TEST_P(LineSoup, IsTheSameAtOtherScales) {
    const LineBvh bvh(scene_);
    for (const float factor : {1024.0f, 1.0f / 1024, 1e3f, 1e-3f}) {
        const scene::Scene other = scaled(scene_, factor);
        const LineBvh other_bvh(other);
        for (int i = 0; i < 10; ++i) {
            LineQuery query = random_query(random_);
            const double share = visible_share(trace<16>(scene_, bvh, query));
            query.point = factor * query.point;
            EXPECT_NEAR(visible_share(trace<16>(other, other_bvh, query)), share, 1e-4) << factor;
        }
    }
}

/// Copies of a soup, one of them a mirror image, one of them thin.
scene::Scene make_instances(std::mt19937& random, int count) {
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    add_soup(scene, 20, random);
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    add_soup(scene, count, random);
    make_object(scene, first);
    scene.instances = {{0, {0.4f, 0.1f, 0, -0.3f, -0.1f, 0.4f, 0, 0.5f, 0, 0, 0.4f, 0.1f}},
                       {0, {-0.5f, 0, 0, 0.4f, 0, 0.3f, 0.2f, -0.5f, 0, -0.1f, 0.3f, 0.8f}},
                       {0, {0.6f, 0.2f, 0, 0, 0, 0.5f, 0, 0.1f, 0.01f, 0, 0.01f, 1.2f}}};
    return scene;
}

TEST(LineBvh, InstancesHideWhatTheirTrianglesHide) {
    std::mt19937 random(3);
    for (const int count : {1, 30, 400}) {
        const scene::Scene scene = make_instances(random, count);
        const scene::Scene flat = without_instances(scene);
        const LineBvh bvh(scene);
        for (int i = 0; i < 60; ++i) {
            const LineQuery query = random_query(random);
            const auto lines = trace<16>(scene, bvh, query);
            ASSERT_TRUE(are_valid(lines));
            ASSERT_LE(difference(lines, cut_by_all(flat, query)), kOrder) << "query " << i;
        }
    }
}

TEST(LineBvh, ClosedRoomsAreDark) {
    std::mt19937 random(5);
    for (const bool is_instance : {false, true}) {
        scene::Scene scene = make_empty_scene();
        add_ceiling_light(scene);
        const auto first = static_cast<std::uint32_t>(scene.triangles.size());
        // Boxes in boxes, and the point in the smallest one.
        for (int i = 0; i < 4; ++i) {
            const float size = 0.7f + 0.1f * static_cast<float>(i);
            add_box(scene, {-size, -size, -size}, {size, 0.9f * size, size});
        }
        if (is_instance) {
            make_object(scene, first);
            scene.instances = {{0, {0.6f, 0.8f, 0, 0.1f, -0.8f, 0.6f, 0, -0.2f, 0, 0, 1.3f, 0.05f}}};
        }
        const LineBvh bvh(scene);
        for (int i = 0; i < 2000; ++i) {
            const auto lines = trace<16>(scene, bvh, random_query(random, 0.5f));
            ASSERT_EQ(visible_share(lines), 0);
        }
    }
}

TEST(LineBvh, LightsHideOthersButNotThemselves) {
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    const LineQuery query{{0.1f, 0.2f, 0}, 0, 0.3f, 16};
    EXPECT_NEAR(visible_share(trace<16>(scene, LineBvh(scene), query)), 1, 1e-6);
    // A larger light occludes it.
    add_light(scene, {-3, -3, 1}, {6, 0, 0}, {0, 6, 0});
    EXPECT_EQ(visible_share(trace<16>(scene, LineBvh(scene), query)), 0);
    LineQuery of_other = query;
    of_other.light = 1;
    EXPECT_NEAR(visible_share(trace<16>(scene, LineBvh(scene), of_other)), 1, 1e-6);
}

TEST(LineBvh, HalfALightIsVisible) {
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    add_triangle(scene, {0, -4, 1}, {4, -4, 1}, {4, 4, 1});
    add_triangle(scene, {0, -4, 1}, {4, 4, 1}, {0, 4, 1});
    const LineBvh bvh(scene);
    for (const float angle : {0.0f, 0.4f, 1.5707963f, 2.5f}) {
        LineQuery query{{0, 0, 0}, 0, angle, 16};
        // The offsets have strata of equal area, but the border of the shadow crosses some of the strata.
        EXPECT_NEAR(visible_share(trace<16>(scene, bvh, query)), 0.5, 0.04) << angle;
    }
}

TEST(LineBvh, SurfacesThatAreNotThereHideNothing) {
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    add_triangle(scene, {-9, -9, 1}, {9, -9, 1}, {0, 20, 1}, kAbsent);
    const LineQuery query{{0.1f, 0.2f, 0}, 0, 0.3f, 16};
    const LineBvh bvh(scene);
    EXPECT_NEAR(visible_share(trace<16>(scene, bvh, query)), 1, 1e-6);
    visibility::LineCounters counters{};
    EXPECT_FALSE(has_partial_surfaces(bvh.view(), seen_light(scene, query), counters));
}

TEST(LineBvh, SurfacesThatArePartlyThereAreFoundInThePyramidOnly) {
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    // Between points around the origin and the light, and as an instance beside them.
    add_triangle(scene, {0, 0, 1}, {0.1f, 0, 1}, {0, 0.1f, 1}, kPartial);
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    add_triangle(scene, {0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, kPartial);
    make_object(scene, first);
    scene.instances = {{0, {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 1}}};
    const LineBvh bvh(scene);
    visibility::LineCounters counters{};
    const auto are_found = [&](const Vec3<float>& point) {
        return has_partial_surfaces(bvh.view(), seen_light(scene, {point, 0, 0.2f, 16}), counters);
    };
    EXPECT_TRUE(are_found({0, 0, 0}));
    EXPECT_TRUE(are_found({10, 0, 0}));
    EXPECT_FALSE(are_found({4, 0, 0}));
    EXPECT_FALSE(are_found({0, 0, 1.5f}));
    // Lines do not see them.
    EXPECT_NEAR(visible_share(trace<16>(scene, bvh, {{0, 0, 0}, 0, 0.2f, 16})), 1, 1e-6);
}

/// Margins for rounding are those of each box: far triangles cost nothing but themselves.
TEST(LineBvh, FarTrianglesDoNotWidenThePyramid) {
    std::mt19937 random(11);
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    add_soup(scene, 20000, random);
    scene::Scene with_far = scene;
    add_triangle(with_far, {-1e7f, -1e7f, -1e7f}, {1e7f, -1e7f, -1e7f}, {0, 1e7f, -1e7f});
    const auto box_tests = [](const scene::Scene& of) {
        const LineBvh bvh(of);
        visibility::LineCounters counters{};
        EXPECT_FALSE(
            has_many_occluders(bvh.view(), seen_light(of, {{3, 0.1f, -0.5f}, 0, 0.2f, 16}), 2500, counters));
        std::mt19937 queries(1);
        using Real = Pack<float, 4>;
        Interval<Real> storage[64];
        for (int i = 0; i < 100; ++i) {
            LineQuery query = random_query(queries);
            query.point.x += 3;
            const SeenLight seen = seen_light(of, query);
            const Interval<float>& offsets = seen.bounds.offsets;
            TracedLines<Real> lines{Real(0.5f * (offsets.begin + offsets.end)),
                                    VisibleParts<Real>(storage, 64)};
            lines.parts.reset({Real(seen.bounds.extent.begin), Real(seen.bounds.extent.end)});
            LineTracer<Real>(bvh.view(), seen, &lines, 1, counters).trace();
        }
        return static_cast<double>(counters.box_tests);
    };
    const double expected = box_tests(scene);
    EXPECT_GT(expected, 1000);
    EXPECT_LE(box_tests(with_far), 1.1 * expected);
}

/// Who decides by what lies in the pyramid has to see the light along a fixed direction.
TEST(LineBvh, PartialSurfacesCountInTheRectangleOfTheDirection) {
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    // The triangle is beside the corner (1, 0.75) of the light as seen from the origin, though its box touches the
    // pyramid.
    add_triangle(scene, {0.51f, 0.373f, 1}, {0.49f, 0.39f, 1}, {0.51f, 0.39f, 1}, kPartial);
    const LineBvh bvh(scene);
    visibility::LineCounters counters{};
    const auto is_found = [&](float angle) {
        return has_partial_surfaces(bvh.view(), seen_light(scene, {{0, 0, 0}, 0, angle, 16}), counters);
    };
    EXPECT_FALSE(is_found(0));
    EXPECT_TRUE(is_found(0.3f));
    // One triangle, twice; the light itself is always there.
    EXPECT_EQ(counters.triangle_tests, 2);
}

TEST(LineBvh, TellsWhereManyOccludersAre) {
    std::mt19937 random(7);
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    add_soup(scene, 3000, random);
    for (const bool are_instances : {false, true}) {
        if (are_instances) {
            scene.objects.push_back({"all", 2, 3000});
            scene.instances.resize(1);
        }
        const LineBvh bvh(scene);
        visibility::LineCounters counters{};
        const auto are_many = [&](const Vec3<float>& point, float angle, int bound) {
            return has_many_occluders(bvh.view(), seen_light(scene, {point, 0, angle, 16}), bound, counters);
        };
        const int blocks = static_cast<int>(bvh.view().full_block_count);
        EXPECT_GT(blocks, 3000 / 8);
        EXPECT_LE(blocks, 3002);
        // Bisection finds the number.
        const auto count = [&](const Vec3<float>& point, float angle) {
            int low = -1;
            int high = blocks;
            while (high - low > 1) {
                const int middle = (low + high) / 2;
                (are_many(point, angle, middle) ? low : high) = middle;
            }
            return high;
        };
        const int below = count({0, 0, -2}, 0.2f);
        EXPECT_GT(below, blocks / 4);
        EXPECT_LT(below, blocks);
        // It depends on the light, not on its lines.
        EXPECT_EQ(count({0, 0, -2}, 1.7f), below);
        // Whoever has counted enough does not look at what is left.
        visibility::LineCounters few{}, all{};
        const SeenLight seen = seen_light(scene, {{0, 0, -2}, 0, 0.2f, 16});
        EXPECT_TRUE(has_many_occluders(bvh.view(), seen, 2, few));
        EXPECT_FALSE(has_many_occluders(bvh.view(), seen, below, all));
        EXPECT_LE(few.box_tests, all.box_tests / 10);
        // Above all triangles but those of the light.
        EXPECT_LE(count({0, 0, 1.8f}, 0.2f), 1);
    }
}

} // namespace
} // namespace nusselt::visibility_test
