#include "viewer/fly_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nusselt::viewer {

namespace {

using scene::Double3;

constexpr int kWidth = 400;
constexpr int kHeight = 300;

/// A camera at (1, 2, 3) that looks along -z, with y upwards.
scene::Camera make_perspective() {
    scene::Camera camera;
    camera.origin = {1, 2, 3};
    camera.corner = {-0.4f, 0.3f, -1};
    camera.right = {0.8f / kWidth, 0, 0};
    camera.down = {0, -0.6f / kHeight, 0};
    return camera;
}

scene::Camera make_parallel() {
    scene::Camera camera;
    camera.origin = {-2, 1.5f, 5};
    camera.origin_right = {4.0f / kWidth, 0, 0};
    camera.origin_down = {0, -3.0f / kHeight, 0};
    camera.corner = {0, 0, -1};
    camera.right = camera.down = {0, 0, 0};
    return camera;
}

void expect_near(const Double3& a, const Double3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-6);
    EXPECT_NEAR(a.y, b.y, 1e-6);
    EXPECT_NEAR(a.z, b.z, 1e-6);
}

/// The direction of the ray through a raster position.
Double3 ray(const scene::Camera& camera, double x, double y) {
    return to_double(camera.corner) + x * to_double(camera.right) + y * to_double(camera.down);
}

TEST(FlyCamera, ChangesNothingByItself) {
    const scene::Camera start = make_perspective();
    FlyCamera fly(start, kWidth, kHeight);
    fly.turn(0, 0);
    fly.move({0, 0, 0});
    const scene::Camera end = fly.camera();
    expect_near(to_double(end.origin), to_double(start.origin));
    expect_near(ray(end, 17, 211), ray(start, 17, 211));
    expect_near(fly.forward(), {0, 0, -1});
    expect_near(fly.right(), {1, 0, 0});
    expect_near(fly.down(), {0, -1, 0});
}

TEST(FlyCamera, MovesAlongTheImage) {
    FlyCamera fly(make_perspective(), kWidth, kHeight);
    fly.move({2, 3, 5});
    expect_near(to_double(fly.camera().origin), {3, -1, -2});
}

TEST(FlyCamera, TurnsWhereItIsToldTo) {
    FlyCamera fly(make_perspective(), kWidth, kHeight);
    fly.turn(std::numbers::pi / 2, 0);
    expect_near(fly.forward(), {1, 0, 0});
    expect_near(fly.right(), {0, 0, 1});
    fly.turn(0, std::numbers::pi / 6);
    expect_near(fly.forward(), {std::sqrt(0.75), 0.5, 0});
    // The image is as wide as before.
    const scene::Camera camera = fly.camera();
    EXPECT_NEAR(length(ray(camera, kWidth, 0) - ray(camera, 0, 0)), 0.8, 1e-6);
    EXPECT_NEAR(dot(ray(camera, kWidth, 0) - ray(camera, 0, 0), {0, 1, 0}), 0, 1e-6) << "upright";
}

TEST(FlyCamera, NeverPassesTheUprightAxis) {
    FlyCamera fly(make_perspective(), kWidth, kHeight);
    for (int i = 0; i < 20; ++i) fly.turn(0.1, 0.5);
    EXPECT_GT(fly.forward().y, 0.99);
    EXPECT_LT(fly.forward().y, 1 - 1e-6);
    for (int i = 0; i < 40; ++i) fly.turn(0.1, -0.5);
    EXPECT_LT(fly.forward().y, -0.99);
    EXPECT_LT(fly.down().y, 0) << "not upside down";
}

TEST(FlyCamera, MirroredImagesTurnTheSameWay) {
    scene::Camera mirrored = make_perspective();
    mirrored.corner.x = 0.4f;
    mirrored.right.x = -mirrored.right.x;
    FlyCamera fly(mirrored, kWidth, kHeight);
    fly.turn(std::numbers::pi / 2, 0);
    expect_near(fly.forward(), {-1, 0, 0});
}

TEST(FlyCamera, OrbitsAboutAPoint) {
    FlyCamera fly(make_perspective(), kWidth, kHeight);
    const Double3 pivot = {1, 2, 0};
    fly.orbit(pivot, std::numbers::pi / 2, 0);
    expect_near(fly.position(), {4, 2, 0});
    expect_near(fly.forward(), {-1, 0, 0});
    fly.orbit(pivot, 0, std::numbers::pi / 6);
    expect_near(fly.position(), {1 + 3 * std::sqrt(0.75), 3.5, 0});
    expect_near(fly.forward(), {-std::sqrt(0.75), -0.5, 0});
    EXPECT_EQ(fly.up(), (Double3{0, 1, 0}));
}

TEST(FlyCamera, ParallelRaysTurnAboutTheMiddle) {
    FlyCamera fly(make_parallel(), kWidth, kHeight);
    const auto middle = [&] {
        const scene::Camera c = fly.camera();
        return to_double(c.origin) + (kWidth / 2) * to_double(c.origin_right) +
               (kHeight / 2) * to_double(c.origin_down);
    };
    expect_near(middle(), {0, 0, 5});
    fly.turn(0.7, 0.2);
    expect_near(middle(), {0, 0, 5});
    fly.move({0, 0, 2});
    expect_near(middle(), Double3{0, 0, 5} + 2 * fly.forward());
}

} // namespace

} // namespace nusselt::viewer
