#include "common/source_folder.h"
#include "toy_light/disc.h"
#include "viewer/lights/light_handles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace nusselt::viewer {
namespace {

using scene::Double3;

constexpr double kWidth = 400;
const Double3 kCenter = {0.3, -0.2, -4};

/// Looks along -z, with y upwards.
scene::Camera make_camera() {
    return {
        .origin = {0, 0, 0}, .corner = {-0.4f, 0.3f, -1}, .right = {0.002f, 0, 0}, .down = {0, -0.002f, 0}};
}

FilmPosition tip_of(std::size_t axis, const LightHandles& handles, const scene::Camera& camera) {
    return handles.lines({HandleAction::move, axis}, camera).back().second;
}

TEST(LightHandles, HaveTheSameSizeAtAnyDistance) {
    const scene::Camera camera = make_camera();
    for (const double scale : {0.1, 1.0, 100.0}) {
        const LightHandles handles(scale * kCenter, camera, kWidth);
        const auto arrow = handles.lines({HandleAction::move, 0}, camera).front();
        EXPECT_NEAR(arrow.second.x - arrow.first.x, 0.1 * kWidth, 1e-3);
        EXPECT_NEAR(arrow.second.y, arrow.first.y, 1e-3);
    }
    const LightHandles behind(-1 * kCenter, camera, kWidth);
    for (const Handle& handle : kHandles) EXPECT_TRUE(behind.lines(handle, camera).empty());
}

TEST(LightHandles, AreFoundByTheMouse) {
    const scene::Camera camera = make_camera();
    const LightHandles handles(kCenter, camera, kWidth);
    EXPECT_EQ(handles.at(tip_of(0, handles, camera), camera, 3), (Handle{HandleAction::move, 0}));
    EXPECT_EQ(handles.at(tip_of(1, handles, camera), camera, 3), (Handle{HandleAction::move, 1}));
    const auto ring = handles.lines({HandleAction::turn, 2}, camera);
    EXPECT_EQ(handles.at(ring[6].first, camera, 3), (Handle{HandleAction::turn, 2}));
    EXPECT_EQ(handles.at({10, 10}, camera, 3), std::nullopt);
}

TEST(LightHandles, MoveAlongTheirAxisOnly) {
    const scene::Camera camera = make_camera();
    const LightHandles handles(kCenter, camera, kWidth);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const FilmPosition from = tip_of(axis, handles, camera);
        const Double3 tip =
            kCenter + handles.length * Double3{axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0};
        const Double3 goal = kCenter + 1.7 * (tip - kCenter);
        const Double3 way = drag_along(axis, kCenter, camera, from, seen_at(camera, goal).value());
        EXPECT_LT(length(way - (goal - tip)), 1e-6) << axis;
    }
}

TEST(LightHandles, RingsFollowTheMouse) {
    const scene::Camera camera = make_camera();
    const auto at = [&](double degrees) {
        const double angle = degrees * 3.14159265358979 / 180;
        return seen_at(camera, kCenter + 0.5 * Double3{std::cos(angle), std::sin(angle), 0}).value();
    };
    EXPECT_LT(length(turn_about(2, kCenter, camera, at(10), at(55)) - Double3{0, 0, 45}), 1e-3);
    EXPECT_LT(length(turn_about(2, kCenter, camera, at(170), at(-170)) - Double3{0, 0, 20}), 1e-3);
}

TEST(LightHandles, OutlinesAreTheEdgesOfPolygons) {
    scene::PolygonLight panel;
    panel.vertices = {{-1, -1, -5}, {1, -1, -5}, {1, 1, -5}, {-1, 1, -5}};
    const FilmLines lines = outline(only(panel), make_camera());
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_NEAR(lines[0].first.x, 100, 1e-3);
    EXPECT_NEAR(lines[0].second.x, 300, 1e-3);
    EXPECT_NEAR(lines[1].second.y, 50, 1e-3);
}

/// The box around lines.
std::pair<FilmPosition, FilmPosition> box_of(const FilmLines& lines) {
    FilmPosition low = lines.front().first;
    FilmPosition high = low;
    for (const auto& [begin, end] : lines) {
        low = {std::min(low.x, begin.x), std::min(low.y, begin.y)};
        high = {std::max(high.x, begin.x), std::max(high.y, begin.y)};
    }
    return {low, high};
}

TEST(LightHandles, OutlinesOfOtherLightsAreWhatIsSeenOfThem) {
    scene::LineLight tube;
    tube.start = {-1, 0, -5};
    tube.end = {1, 0, -5};
    tube.radius = 0.1f;
    const auto [low, high] = box_of(outline(only(tube), make_camera()));
    EXPECT_NEAR(low.x, 100, 3);
    EXPECT_NEAR(high.x, 300, 3);
    EXPECT_NEAR(high.y - low.y, 20, 1);
    scene::DiscLight disc;
    disc.center = {0, 0, -5};
    disc.normal = {0, 0, 1};
    disc.radius = 1;
    double length = 0;
    for (const auto& [begin, end] : outline(only(disc), make_camera()))
        length += std::hypot(end.x - begin.x, end.y - begin.y);
    EXPECT_NEAR(length, 2 * 3.14159 * 100, 2);
}

TEST(LightHandles, LightsOfVeryManyPartsShowABox) {
    scene::Lights parts;
    for (int i = 0; i < 2000; ++i) {
        const float x = 1e-3f * static_cast<float>(i);
        scene::PolygonLight panel;
        panel.vertices = {{x, -1, -5}, {x + 1e-3f, -1, -5}, {x + 1e-3f, 1, -5}, {x, 1, -5}};
        parts.append(only(panel));
    }
    EXPECT_EQ(outline(parts, make_camera()).size(), 12u);
}

} // namespace
} // namespace nusselt::viewer
