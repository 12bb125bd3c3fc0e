/// Lines of lights in scenes and from points that are not as one would wish.

#include "line_queries.h"
#include "soups.h"

#include <gtest/gtest.h>

#include <limits>

namespace nusselt::visibility_test {
namespace {

using visibility::LineBvh;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class HostilePoints : public testing::Test {
protected:
    HostilePoints() : scene_(make_empty_scene()) {
        std::mt19937 random(1);
        add_ceiling_light(scene_);
        add_soup(scene_, 300, random);
        add_box(scene_, {-1, -1, -1}, {1, 1, 2});
    }

    std::vector<VisibleLine> lines(const Vec3<float>& point, float angle) const {
        return trace<8>(scene_, LineBvh(scene_), {point, 0, angle, 16});
    }

    scene::Scene scene_;
};

TEST_F(HostilePoints, SeeNothingOfLightsInTheirPlaneOrFromNowhere) {
    for (const Vec3<float>& point : {Vec3<float>{kNan, 0, 0},
                                     {0, kNan, 0},
                                     {0, 0, kNan},
                                     {kInfinity, 0, 0},
                                     {0, 0, -kInfinity},
                                     {0, 0, 2},
                                     {-1, -0.75f, 2},
                                     {1, 0, 2},
                                     {50, 60, 2},
                                     {3e38f, 3e38f, 3e38f}})
        for (const float angle : {0.0f, 0.7f, 1.5707963f})
            EXPECT_EQ(visible_share(lines(point, angle)), 0) << point.x << " " << point.y << " " << point.z;
}

TEST_F(HostilePoints, GetValidParts) {
    std::vector<Vec3<float>> points = {{0, 0, 0},     {0, 0, 1.9999999f}, {-1, -0.75f, 1.9999f}, {1, 1, 1},
                                       {-1, -1, -1},  {1, 0, 0.5f},       {0, 0, 1e-30f},        {1e6f, 0, 0},
                                       {1e-3f, 0, 3}, {0, 1e18f, 0},      {1e30f, 1e30f, -1e30f}};
    // Points on occluders: corners, centres of edges, centres.
    for (const scene::Triangle& triangle : scene_.triangles) {
        const scene::Float3& a = scene_.positions[triangle.vertex[0]];
        const scene::Float3& b = scene_.positions[triangle.vertex[1]];
        points.push_back({a.x, a.y, a.z});
        points.push_back({0.5f * (a.x + b.x), 0.5f * (a.y + b.y), 0.5f * (a.z + b.z)});
    }
    const LineBvh bvh(scene_);
    for (const Vec3<float>& point : points)
        for (const float angle : {0.0f, 0.7f, 1.5707963f}) {
            const auto visible = trace<8>(scene_, bvh, {point, 0, angle, 16});
            ASSERT_TRUE(are_valid(visible)) << point.x << " " << point.y << " " << point.z << " " << angle;
        }
}

/// A wall at the level of the point: rays to the light meet it beyond t = 10 or so, on both sides of the edge.
TEST(HostileTriangles, WithAnEdgeOnTheLevelOfThePoint) {
    for (const float side : {1.0f, -1.0f}) {
        const ShadowFrame<float> frame = make_shadow_frame<float>(
            {{-1.92792f, side * 0.246144f, 1.62f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0});
        const Vec3<float> a{0.0843126f, side * -0.987118f, 0};
        const Vec3<float> b{-0.0858566f, side * 1.00563f, 0};
        const Vec3<float> c{-0.0858566f, side * 1.00563f, 2};
        ASSERT_TRUE(make_triangle_shadow(frame, a, b, c).partial);
        const Interval<float> hidden = hidden_interval(make_partial_shadow(frame, a, b, c), 1.04805f);
        const auto is_hidden = [&](float t) { return hidden.begin < t && t < hidden.end; };
        EXPECT_FALSE(is_hidden(side * 1));
        EXPECT_FALSE(is_hidden(side * 9));
        EXPECT_FALSE(is_hidden(side * -30));
        EXPECT_TRUE(is_hidden(side * 11));
        EXPECT_TRUE(is_hidden(side * 30));
    }
}

TEST(HostileTriangles, AreLeftOutOrHideNothing) {
    std::mt19937 random(2);
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    add_soup(scene, 50, random);
    const scene::Scene sound = scene;
    for (const float bad : {kNan, kInfinity, -kInfinity, 3e38f}) {
        add_triangle(scene, {bad, 0, 1}, {0, 1, 1}, {1, 0, 1});
        add_triangle(scene, {0, 0, 1}, {0, bad, 1}, {1, 0, 1});
        add_triangle(scene, {bad, bad, bad}, {bad, bad, bad}, {bad, bad, bad});
    }
    // A triangle without area.
    add_triangle(scene, {0, 0, 1}, {0, 0, 1}, {0, 0, 1});
    add_triangle(scene, {0, 0, 1}, {1, 0, 1}, {0.5f, 0, 1});
    const LineBvh bvh(scene);
    for (int i = 0; i < 20; ++i) {
        const LineQuery query{{0.1f * static_cast<float>(i), 0, -1.5f}, 0, 0.1f * static_cast<float>(i), 16};
        const auto lines = trace<16>(scene, bvh, query);
        ASSERT_TRUE(are_valid(lines));
        EXPECT_LE(difference(lines, cut_by_all(sound, query)), 1e-5);
    }
}

TEST(HostileInstances, AreLeftOutOrHideNothing) {
    std::mt19937 random(3);
    scene::Scene sound = make_empty_scene();
    add_ceiling_light(sound);
    add_soup(sound, 50, random);
    const auto first = static_cast<std::uint32_t>(sound.triangles.size());
    add_soup(sound, 50, random);
    make_object(sound, first);
    sound.instances = {{0, {0.4f, 0.1f, 0, -0.3f, -0.1f, 0.4f, 0, 0.5f, 0, 0, 0.4f, 0.1f}}};
    scene::Scene scene = sound;
    for (const float bad : {kNan, kInfinity, -kInfinity, 3e38f}) {
        scene.instances.push_back({0, {1, 0, 0, bad, 0, 1, 0, bad, 0, 0, 1, bad}});
        scene.instances.push_back({0, {bad, bad, 0, 0, 0, bad, 0, 0, bad, 0, bad, 0}});
    }
    const LineBvh bvh(scene);
    const LineBvh expected(sound);
    EXPECT_EQ(bvh.view().full_block_count, expected.view().full_block_count);
    for (int i = 0; i < 20; ++i) {
        const LineQuery query{{0.1f * static_cast<float>(i), 0, -1.5f}, 0, 0.1f * static_cast<float>(i), 16};
        const auto lines = trace<16>(scene, bvh, query);
        ASSERT_TRUE(are_valid(lines));
        EXPECT_LE(difference(lines, trace<16>(sound, expected, query)), 1e-5);
    }
}

TEST(HostileTriangles, InOnePlaceGiveNoDeepHierarchy) {
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    for (int i = 0; i < 20000; ++i) add_triangle(scene, {0, -4, 1}, {4, -4, 1}, {2, 4, 1});
    const scene::Scene one = [] {
        scene::Scene result = make_empty_scene();
        add_ceiling_light(result);
        add_triangle(result, {0, -4, 1}, {4, -4, 1}, {2, 4, 1});
        return result;
    }();
    const LineQuery query{{0, 0, 0}, 0, 0.3f, 16};
    EXPECT_LE(difference(trace<16>(scene, LineBvh(scene), query), cut_by_all(one, query)), 1e-6);
}

TEST(HostileTriangles, WithNanInOneCornerAreLeftOut) {
    scene::Scene scene = make_empty_scene();
    for (int corner = 0; corner < 3; ++corner) {
        add_triangle(scene, {0, -4, 1}, {4, -4, 1}, {2, 4, 1});
        scene.positions[static_cast<std::size_t>(4 * corner)].y = kNan;
    }
    EXPECT_EQ(LineBvh(scene).view().full_block_count, 0u);
}

TEST(HostileTriangles, ScenesWithoutAnyAreFine) {
    scene::Scene scene = make_empty_scene();
    add_ceiling_light(scene);
    scene.triangles.clear();
    scene.triangle_material.clear();
    scene.triangle_light.clear();
    // An object without triangles too.
    make_object(scene, 0);
    scene.instances.resize(2);
    const LineBvh bvh(scene);
    EXPECT_NEAR(visible_share(trace<4>(scene, bvh, {{0, 0, 0}, 0, 0.3f, 16})), 1, 1e-6);
    visibility::LineCounters counters{};
    EXPECT_FALSE(has_many_occluders(bvh.view(), seen_light(scene, {{0, 0, 0}, 0, 0.3f, 16}), 0, counters));
}

} // namespace
} // namespace nusselt::visibility_test
