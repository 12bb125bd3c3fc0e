// A fingerprint distinguishes scenes, whatever differs.

#include "scene/model/fingerprint.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

namespace nusselt::scene {
namespace {

Scene make_scene() {
    Scene scene;
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}};
    scene.triangles = {{{0, 1, 2}}};
    scene.triangle_material = {0};
    scene.triangle_light = {-1};
    scene.objects = {{"chair", 1, 0}};
    scene.instances = {{}};
    scene.materials = {{}};
    scene.textures = {{"wood.png", 1, 1, {0.1f, 0.2f, 0.3f}}};
    scene.emitters = {{"lamp"}, {"tube"}};
    scene.lights.of<PolygonLight>() = {{0, -1, {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}, {1, 1, 1}, false}};
    scene.lights.of<LineLight>() = {{1, {0, 0, 1}, {1, 0, 1}, 0.1f, {2, 2, 2}, TubeModel::solid}};
    return scene;
}

const std::function<void(Scene&)> kChanges[] = {
    [](Scene& s) { s.positions[1].x = 1.0000001f; },
    [](Scene& s) { s.normals[2].z = -1; },
    [](Scene& s) { s.uvs[0].y = 0.5f; },
    [](Scene& s) { s.triangles[0].vertex[2] = 1; },
    [](Scene& s) { s.triangle_material[0] = 1; },
    [](Scene& s) { s.triangle_light[0] = 0; },
    [](Scene& s) { s.objects[0].triangle_count = 1; },
    [](Scene& s) { s.instances[0].world_from_object[3] = 1; },
    [](Scene& s) { s.instances.push_back({}); },
    [](Scene& s) { s.materials[0].model = BrdfModel::frostbite; },
    [](Scene& s) { s.materials[0].roughness = 0.5f; },
    [](Scene& s) { s.materials[0].exponent = 50; },
    [](Scene& s) { s.materials[0].diffuse_texture.texture = 0; },
    [](Scene& s) { s.materials[0].bump_unit = BumpUnit::texture_coordinate; },
    [](Scene& s) { s.textures[0].texels[1] = 0.25f; },
    [](Scene& s) { s.lights.of<PolygonLight>()[0].two_sided = true; },
    [](Scene& s) { s.lights.of<PolygonLight>()[0].vertices[1].x = 2; },
    [](Scene& s) {
        s.lights.of<PolygonLight>()[0].vertices.push_back({0, 0, 2});
    },
    [](Scene& s) { s.lights.of<LineLight>()[0].radius = 0.2f; },
    [](Scene& s) { s.lights.of<LineLight>()[0].model = TubeModel::linear; },
    [](Scene& s) { s.lights.of<LineLight>()[0].normal.z = 1; },
    [](Scene& s) { s.camera.origin_right.x = 1; },
    [](Scene& s) { s.camera.corner.z = 2; },
    [](Scene& s) { s.film.width = 641; },
    [](Scene& s) {
        s.film.crop = PixelBounds{0, 0, 640, 480};
    },
    [](Scene& s) { s.film.filter.radius_x = 1; },
    // The same numbers in other places.
    [](Scene& s) { std::swap(s.positions, s.normals); },
    [](Scene& s) { s.lights.of<LineLight>()[0].emitter = 0; },
};

TEST(Fingerprint, AnyChangeGivesAnotherOne) {
    std::set<std::string> seen = {fingerprint(make_scene())};
    for (const auto& change : kChanges) {
        Scene scene = make_scene();
        change(scene);
        EXPECT_TRUE(seen.insert(fingerprint(scene)).second) << &change - kChanges;
    }
}

TEST(Fingerprint, IsAFunctionOfTheContents) {
    Scene scene = make_scene();
    const std::string expected = fingerprint(scene);
    EXPECT_EQ(expected.size(), 16u);
    EXPECT_EQ(expected.find_first_not_of("0123456789abcdef"), std::string::npos);
    scene.positions.reserve(1000);
    scene.warnings = {"something"};
    scene.film.filename = "other.exr";
    scene.textures[0].name = "copy of wood.png";
    scene.emitters[0].name = "polygon at other/folder/scene.pbrt:7";
    EXPECT_EQ(fingerprint(scene), expected);
}

} // namespace
} // namespace nusselt::scene
