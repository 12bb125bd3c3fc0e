#include "common/source_folder.h"
#include "toy_light/disc.h"
#include "toy_light/faulty_disc.h"
#include "viewer/lights/picking.h"

#include "scene/import/importers.h"
#include "scene/rig/light_edit.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace nusselt::viewer {
namespace {

using scene::Double3;

scene::Scene load(const char* name) {
    return scene::load_scene(std::filesystem::path(nusselt_test::kSourceFolder) / "scenes" / name);
}

/// The position of a point in front of the camera.
FilmPosition position_of(const scene::Camera& camera, const Double3& point) {
    return seen_at(camera, point).value();
}

Double3 center_of(const scene::Scene& scene, std::size_t light) {
    return centroid(editable_lights(scene)[light]);
}

TEST(Picking, FindsPanelsAndTubes) {
    for (const char* name : {"cornell-panel.pbrt", "cornell-tube.pbrt"}) {
        SCOPED_TRACE(name);
        const scene::Scene scene = load(name);
        const FilmPosition middle = position_of(scene.camera, center_of(scene, 0));
        EXPECT_EQ(light_at(scene, {}, scene.camera, middle), std::size_t{0});
        EXPECT_EQ(light_at(scene, {}, scene.camera, {middle.x, middle.y + 200}), std::nullopt);
        EXPECT_EQ(light_at(scene, {}, scene.camera, {1, 1}), std::nullopt);
    }
}

/// A scene with one light, a metre in front of the camera.
template <class Light>
scene::Scene scene_of(Light light) {
    scene::Scene scene;
    scene.emitters = {{"light"}};
    light.center = {0, 0, 1};
    light.normal = {0, 0, -1};
    light.radius = 0.1f;
    scene.lights.of<Light>() = {light};
    scene.camera = {.corner = {0, 0, 1}, .right = {1e-2f, 0, 0}, .down = {0, 1e-2f, 0}};
    return scene;
}

TEST(Picking, FindsLightsOfAnyKind) {
    const scene::Scene scene = scene_of(scene::DiscLight());
    EXPECT_EQ(light_at(scene, {}, scene.camera, {9, 0}), std::size_t{0});
    EXPECT_EQ(light_at(scene, {}, scene.camera, {11, 0}), std::nullopt);
    LightEdits edits;
    edits.set(0, {{0.15, 0, 0}, 1, 1, true});
    EXPECT_EQ(light_at(scene, edits, scene.camera, {9, 0}), std::size_t{0});
    EXPECT_EQ(light_at(scene, edits, scene.camera, {-9, 0}), std::nullopt);
    const Double3 way = drag_of({0, 0, 1}, scene.camera, {0, 0}, {20, 0});
    EXPECT_NEAR(way.x, 0.2, 1e-6);
    // Where a row misses all rays, no other code finds the light.
    const scene::Scene never_hit = scene_of(scene::FaultyDisc<scene::Fault::hit>());
    EXPECT_EQ(light_at(never_hit, {}, never_hit.camera, {0, 0}), std::nullopt);
}

TEST(Picking, FollowsEdits) {
    const scene::Scene scene = load("cornell-panel.pbrt");
    const FilmPosition before = position_of(scene.camera, center_of(scene, 0));
    LightEdits edits;
    edits.set(0, {{0, -1, 0}, 1, 1, true});
    const FilmPosition after = position_of(scene.camera, center_of(scene, 0) + Double3{0, -1, 0});
    EXPECT_EQ(light_at(scene, edits, scene.camera, after), std::size_t{0});
    EXPECT_EQ(light_at(scene, edits, scene.camera, before), std::nullopt);
    edits.set(0, {{0, 0, 0}, 1e-3, 1, true});
    EXPECT_EQ(light_at(scene, edits, scene.camera, {before.x + 20, before.y}), std::nullopt)
        << "it is tiny now";
    edits.set(0, {{0, 0, 0}, 1, 1, false});
    EXPECT_EQ(light_at(scene, edits, scene.camera, before), std::nullopt) << "it is switched off";
}

TEST(Picking, TakesTheNearerLight) {
    scene::Scene scene = load("cornell-panel.pbrt");
    scene::PolygonLight nearer = scene.lights.of<scene::PolygonLight>().front();
    nearer.emitter = 1;
    for (scene::Float3& p : nearer.vertices) p.y -= 0.3f;
    scene.lights.of<scene::PolygonLight>().push_back(nearer);
    scene.emitters.push_back({"nearer"});
    // Seen from below, straight up, beside the centroid.
    const scene::Float3 below = to_float(center_of(scene, 0) + Double3{0.02, -1, 0.01});
    scene.camera = {.origin = below, .corner = {0, 1, 0}, .right = {1e-3f, 0, 0}, .down = {0, 0, 1e-3f}};
    EXPECT_EQ(light_at(scene, {}, scene.camera, {0, 0}), std::size_t{1});
    LightEdits edits;
    edits.set(1, {{0, 2, 0}, 1, 1, true});
    EXPECT_EQ(light_at(scene, edits, scene.camera, {0, 0}), std::size_t{0});
}

TEST(Picking, DragsLightsWithTheMouse) {
    const scene::Scene scene = load("cornell-panel.pbrt");
    LightEdits edits;
    edits.set(0, {{0.1, -0.4, 0.2}, 1, 1, true});
    const Double3 center = center_of(scene, 0) + edits.get(0).move;
    const FilmPosition from = position_of(scene.camera, center);
    const FilmPosition to = {from.x + 37, from.y - 21};
    const Double3 way = drag_of(edits.center(scene, 0), scene.camera, from, to);
    const FilmPosition arrived = position_of(scene.camera, center + way);
    EXPECT_NEAR(arrived.x, to.x, 1e-6);
    EXPECT_NEAR(arrived.y, to.y, 1e-6);
    EXPECT_NEAR(dot(way, cross(to_double(scene.camera.right), to_double(scene.camera.down))), 0, 1e-12);
}

TEST(Picking, LeavesLightsBehindTheCameraAlone) {
    scene::Scene scene = load("cornell-panel.pbrt");
    scene.camera.corner = to_float(-1 * to_double(scene.camera.corner));
    const Double3 way = drag_of(center_of(scene, 0), scene.camera, {10, 10}, {20, 20});
    EXPECT_EQ(way, Double3{});
}

TEST(Picking, SeesPointsWhereTheirRaysPass) {
    const scene::Camera perspective = load("room.pbrt").camera;
    scene::Camera parallel;
    parallel.origin = {-2, 1.5f, 5};
    parallel.origin_right = {0.01f, 0.002f, 0};
    parallel.origin_down = {0, -0.01f, 0.001f};
    parallel.corner = {0.1f, 0, -1};
    parallel.right = parallel.down = {0, 0, 0};
    for (const scene::Camera& camera : {perspective, parallel}) {
        const FilmPosition at = {123.5, 77.25};
        const scene::SightRay ray = ray_through(camera, at);
        const auto seen = seen_at(camera, ray.origin + 2.5 * ray.direction);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->x, at.x, 1e-6);
        EXPECT_NEAR(seen->y, at.y, 1e-6);
        EXPECT_FALSE(seen_at(camera, ray.origin - 2.5 * ray.direction)) << "it is behind the camera";
    }
}

TEST(Picking, CutsLinesBehindTheCamera) {
    const scene::Camera camera = load("room.pbrt").camera;
    const scene::SightRay left = ray_through(camera, {20, 50});
    const scene::SightRay right = ray_through(camera, {80, 50});
    const Double3 front = left.origin + 3 * left.direction;
    const auto whole = seen_line(camera, front, right.origin + 2 * right.direction);
    ASSERT_TRUE(whole);
    EXPECT_NEAR(whole->first.x, 20, 1e-6);
    EXPECT_NEAR(whole->second.x, 80, 1e-6);
    // The other end is behind the camera, where its projection would be on the other side.
    const auto cut = seen_line(camera, front, right.origin - 2 * right.direction);
    ASSERT_TRUE(cut);
    EXPECT_NEAR(cut->first.x, 20, 1e-6);
    EXPECT_LT(cut->second.x, 20);
    EXPECT_NEAR(cut->second.y, 50, 1e-6);
    EXPECT_FALSE(seen_line(camera, left.origin - left.direction, right.origin - right.direction));
}

} // namespace
} // namespace nusselt::viewer
