// Light rigs: cases that tests/scene/rigs cannot express in numbers.

#include "common/source_folder.h"
#include "scene/colour/colour_space.h"
#include "scene/model/fingerprint.h"
#include "scene/rig/rig.h"
#include "scene/rig/rig_json.h"
#include "scene/rig/rig_text.h"
#include "scene_fixture.h"

#include <cstring>
#include <random>

namespace nusselt::scene {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes";

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same(const Float3& a, const Float3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// Expects two scenes to be equal bit by bit, apart from names, materials, textures and warnings.
void expect_same_geometry(const Scene& a, const Scene& b) {
    EXPECT_TRUE(same_bytes(a.positions, b.positions));
    EXPECT_TRUE(same_bytes(a.normals, b.normals));
    EXPECT_TRUE(same_bytes(a.uvs, b.uvs));
    EXPECT_TRUE(same_bytes(a.triangles, b.triangles));
    EXPECT_TRUE(same_bytes(a.triangle_material, b.triangle_material));
    EXPECT_TRUE(same_bytes(a.triangle_light, b.triangle_light));
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.emitters.size(), b.emitters.size());
    ASSERT_EQ(a.lights.of<PolygonLight>().size(), b.lights.of<PolygonLight>().size());
    ASSERT_EQ(a.lights.of<LineLight>().size(), b.lights.of<LineLight>().size());
    for (std::size_t i = 0; i < a.lights.of<PolygonLight>().size(); ++i) {
        const PolygonLight& p = a.lights.of<PolygonLight>()[i];
        const PolygonLight& q = b.lights.of<PolygonLight>()[i];
        EXPECT_EQ(p.emitter, q.emitter);
        EXPECT_EQ(p.two_sided, q.two_sided);
        EXPECT_TRUE(same(p.radiance, q.radiance)) << i;
        EXPECT_TRUE(
            std::equal(p.vertices.begin(), p.vertices.end(), q.vertices.begin(), q.vertices.end(), same))
            << i;
    }
    for (std::size_t i = 0; i < a.lights.of<LineLight>().size(); ++i) {
        const LineLight& p = a.lights.of<LineLight>()[i];
        const LineLight& q = b.lights.of<LineLight>()[i];
        EXPECT_TRUE(same(p.start, q.start) && same(p.end, q.end) && same(p.radiance, q.radiance)) << i;
        EXPECT_EQ(p.radius, q.radius);
        EXPECT_EQ(p.model, q.model);
        EXPECT_EQ(p.emitter, q.emitter);
    }
}

class RigTest : public SceneTest {
protected:
    void apply(std::string_view lights, Scene& scene) const {
        apply_text("{\"version\": 1, \"lights\": [" + std::string(lights) + "]}", scene);
    }
    void apply_text(const std::string& text, Scene& scene) const {
        write("rig.json", text);
        apply_rig(read_rig(folder_ / "rig.json"), scene);
    }
    std::string rig_error(const std::string& text) const {
        write("rig.json", text);
        try {
            read_rig(folder_ / "rig.json");
        } catch (const std::runtime_error& error) {
            return without_folder(error.what());
        }
        return "no error";
    }
};

TEST_F(RigTest, TextsAreReadAsFilesAre) {
    const std::string text = R"({"version": 1, "lights": [{"light": 3, "power": 2}]})";
    write("rig.json", text);
    const Rig read = read_rig(folder_ / "rig.json");
    const Rig parsed = parse_rig(text, folder_ / "text");
    ASSERT_EQ(parsed.lights.size(), 1u);
    EXPECT_EQ(std::get<Selector>(parsed.lights[0].lights), std::get<Selector>(read.lights[0].lights));
    EXPECT_EQ(parsed.lights[0].changes.power, read.lights[0].changes.power);
    EXPECT_EQ(without_folder(parsed.lights[0].where), "text: lights[0]");
    EXPECT_THROW(parse_rig(text.substr(1), "text"), std::runtime_error);
}

TEST_F(RigTest, PatternsMatch) {
    for (const auto& [text, pattern] : {std::pair("lamp 12", "lamp 12"),
                                        {"lamp 12", "*"},
                                        {"lamp 12", "lamp*"},
                                        {"lamp 12", "*12"},
                                        {"lamp 12", "l?mp ??"},
                                        {"lamp 12", "*a*1*"},
                                        {"lamp 12", "**lamp 12**"},
                                        {"aaab", "*aab"},
                                        {"abcabd", "*ab?"},
                                        {"", ""},
                                        {"", "*"}})
        EXPECT_TRUE(matches(text, pattern)) << text << " " << pattern;
    for (const auto& [text, pattern] : {std::pair("lamp 12", "lamp"),
                                        {"lamp 12", "amp*"},
                                        {"lamp 12", "*1"},
                                        {"lamp 12", "lamp ???"},
                                        {"lamp 12", ""},
                                        {"", "?"},
                                        {"aaab", "*aaaab"},
                                        {"ab", "a*b*c"}})
        EXPECT_FALSE(matches(text, pattern)) << text << " " << pattern;
    // Without its memory of one star only, this would take longer than the universe has existed.
    EXPECT_FALSE(matches(std::string(10000, 'a'), "*a*a*a*a*a*a*a*a*a*a*a*a*a*a*a*a*a*b"));
}

TEST_F(RigTest, PrintedRigsChangeNothing) {
    const std::filesystem::path tests = std::filesystem::path(nusselt_test::kSourceFolder) / "tests/scene";
    std::vector<std::filesystem::path> scenes = {
        tests / "rigs/lamps.pbrt", tests / "rigs/light-sources.pbrt", tests / "corpus/lights/spot-v3.pbrt",
        tests / "corpus/lights/distant.pbrt", tests / "corpus/lights/projection.pbrt"};
    for (const auto& entry : std::filesystem::directory_iterator(kScenes))
        if (entry.path().extension() == ".pbrt") scenes.push_back(entry.path());
    ASSERT_GE(scenes.size(), 8u);
    for (const std::filesystem::path& path : scenes) {
        SCOPED_TRACE(path.string());
        const Scene original = load_scene(path);
        Scene scene = original;
        apply_text(to_rig_text(original), scene);
        expect_same_geometry(scene, original);
        // A rig that replaces shapes brings along a material for them.
        scene.materials = original.materials;
        EXPECT_EQ(fingerprint(scene), fingerprint(original));
        EXPECT_EQ(to_rig_text(scene), to_rig_text(original));
    }
}

/// The rig of a scene whose lights were given files makes the same of the scene without them.
TEST_F(RigTest, PrintedRigsBringFilesBack) {
    const std::filesystem::path folder =
        std::filesystem::path(nusselt_test::kSourceFolder) / "tests/scene/rigs";
    const auto file = [&](const char* name) { return "\"" + (folder / name).string() + "\""; };
    const auto expect_same = [&](const char* name, const std::string& entries) {
        const Scene original = load_scene(folder / name);
        Scene changed = original;
        apply(entries, changed);
        Scene again = original;
        apply_text(to_rig_text(changed), again);
        again.materials = changed.materials;
        EXPECT_EQ(fingerprint(again), fingerprint(changed)) << to_rig_text(changed);
        EXPECT_NE(fingerprint(changed), fingerprint(original));
    };
    expect_same("lamps.pbrt", R"({"light": 0, "image": )" + file("red-and-blue.pfm") +
                                  R"(}, {"light": 1, "honeycomb": [30, 40]}, {"light": 2, "ies": )" +
                                  file("lambert.ies") + R"(, "spread": 50})");
    expect_same("sky.pbrt", R"({"light": 0, "image_scale": 3, "map": )" + file("red-and-blue.pfm") + "}");
}

TEST_F(RigTest, PrintedNumbersAreExact) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> exponent(-20, 20);
    std::uniform_real_distribution<float> mantissa(-1, 1);
    const auto number = [&] { return mantissa(generator) * std::exp2(exponent(generator)); };
    Scene original;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        original.emitters.push_back({"tube " + std::to_string(i)});
        LineLight tube;
        tube.emitter = i;
        tube.start = {number(), number(), number()};
        tube.end = {number(), number(), number()};
        tube.radius = std::fabs(number());
        tube.radiance = {std::fabs(number()), std::fabs(number()), std::fabs(number())};
        original.lights.of<LineLight>().push_back(tube);
    }
    Scene scene = original;
    scene.lights.of<LineLight>().clear();
    for (LineLight tube : original.lights.of<LineLight>()) {
        tube.radius = 1;
        tube.start = {1, 2, 3};
        tube.radiance = {1, 1, 1};
        scene.lights.of<LineLight>().push_back(tube);
    }
    apply_text(to_rig_text(original), scene);
    original.radius = scene.radius;
    expect_same_geometry(scene, original);
}

TEST_F(RigTest, NamesThatAreNoUtf8AreNotPrinted) {
    Scene scene = load_scene(kScenes / "room.pbrt");
    scene.emitters[1].name = "\xff\xfe";
    const std::string text = to_rig_text(scene);
    Scene copy = scene;
    apply_text(text, copy);
    EXPECT_EQ(copy.emitters[1].name, "\xff\xfe");
    expect_same_geometry(copy, scene);
}

/// A scene with a triangulated light that has shading normals, somewhere; and a floor in front of it and behind it.
std::string scene_with_light(const std::string& transform) {
    const std::string floor = "Shape \"polygon\" \"point3 P\" [ -2 0 2   2 0 2   2 0 -2   -2 0 -2 ]\n";
    return "Camera \"perspective\"\nWorldBegin\nMaterial \"diffuse\"\n" + floor + "AttributeBegin\n" +
           transform +
           "\nAreaLightSource \"diffuse\" \"rgb L\" [ 1 2 3 ]\n"
           "Shape \"trianglemesh\" \"integer indices\" [ 0 2 1  0 3 2 ]\n"
           "  \"point3 P\" [ 0 1 0   1 1 0   1 1 1   0 1 1 ]\n"
           "  \"normal N\" [ 0 1 0   0 1 0   0.6 0.8 0   0 0.8 0.6 ]\nAttributeEnd\n" +
           floor;
}

TEST_F(RigTest, MovedLightsEqualThoseOfAMovedSceneFile) {
    Scene scene = load(scene_with_light(""));
    apply(R"({"light": 0, "move": [0.5, 0.25, -1]})", scene);
    expect_same_geometry(scene, load(scene_with_light("Translate 0.5 0.25 -1")));
}

TEST_F(RigTest, TurnedAndScaledLightsEqualThoseOfASceneFile) {
    // The centroid of the light is (0.5, 1, 0.5).
    const Scene expected = load(scene_with_light("Translate 0.5 1 0.5 Rotate 30 1 0 0 Scale 2 1 0.5 "
                                                 "Translate -0.5 -1 -0.5"));
    Scene scene = load(scene_with_light(""));
    apply(R"({"light": 0, "scale": [2, 1, 0.5], "rotate": {"axis": [3, 0, 0], "degrees": 30}})", scene);
    ASSERT_EQ(scene.positions.size(), expected.positions.size());
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        expect_near(scene.positions[i], expected.positions[i], 1e-6f);
        expect_near(scene.normals[i], expected.normals[i], 1e-6f);
    }
    EXPECT_TRUE(same_bytes(scene.triangles, expected.triangles));
    for (std::size_t i = 0; i < 4; ++i)
        expect_near(scene.lights.of<PolygonLight>()[0].vertices[i],
                    expected.lights.of<PolygonLight>()[0].vertices[i], 1e-6f);
}

TEST_F(RigTest, SeveralRigsActOnWhatThoseBeforeLeave) {
    Scene scene = load_scene(kScenes / "room.pbrt");
    apply(R"({"light": 0, "remove": true}, {"light": 2, "name": "glow"})", scene);
    apply(R"({"light": 1, "radiance": 7})", scene);
    ASSERT_EQ(scene.emitters.size(), 2u);
    EXPECT_EQ(scene.emitters[1].name, "glow");
    EXPECT_EQ(scene.lights.of<PolygonLight>()[1].radiance.x, 7);
}

TEST_F(RigTest, RemovedLightsDoNotCountForTheSizeOfTheScene) {
    Scene scene = load(scene_with_light("Translate 0 100 0"));
    apply(R"({"light": 0, "remove": true})", scene);
    EXPECT_DOUBLE_EQ(scene.radius, std::sqrt(8.0));
    apply(R"({"add": "far", "tube": {"begin": [-1, 0, 0], "end": [1, 0, 0], "radius": 6}, "radiance": 1})",
          scene);
    EXPECT_DOUBLE_EQ(scene.radius, 0.5 * std::sqrt(14.0 * 14 + 12 * 12 + 12 * 12));
}

TEST_F(RigTest, InstancesCountForTheSizeOfTheScene) {
    Scene scene = load(scene_with_light(""));
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    // A triangle far away in its own coordinates, but not in the world.
    for (const float x : {100.0f, 101.0f, 100.0f}) scene.positions.push_back({x, x - 100, x});
    scene.normals.resize(first + 3);
    scene.uvs.resize(first + 3);
    scene.objects = {{"leaf", static_cast<std::uint32_t>(scene.triangles.size()), 1}};
    scene.triangles.push_back({{first, first + 1, first + 2}});
    scene.triangle_material.push_back(0);
    scene.triangle_light.push_back(-1);
    scene.instances = {{0, {2, 0, 0, -200, 0, 2, 0, 0, 0, 0, 2, -196}}};
    apply(R"({"light": 0, "move": [0, 0.5, 0]})", scene);
    // The scene extends from (-2, 0, -2) to (2, 2, 6).
    EXPECT_DOUBLE_EQ(scene.radius, 0.5 * std::sqrt(16.0 + 4 + 64));
}

/// Two triangles that share an edge and belong to different lights, then a surface that shares one of its vertices.
Scene scene_with_shared_vertices() {
    Scene scene;
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 0}};
    scene.normals.assign(5, {0, 0, 1});
    scene.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 2}};
    scene.triangles = {{{0, 1, 2}}, {{0, 2, 3}}, {{3, 2, 4}}};
    scene.triangle_material = {0, 0, 0};
    scene.triangle_light = {0, 1, -1};
    scene.materials.emplace_back();
    scene.emitters = {{"a"}, {"b"}};
    for (std::uint32_t i = 0; i < 2; ++i) {
        PolygonLight light;
        light.emitter = i;
        light.radiance = {1, 1, 1};
        for (const std::uint32_t vertex : scene.triangles[i].vertex)
            light.vertices.push_back(scene.positions[vertex]);
        scene.lights.of<PolygonLight>().push_back(light);
    }
    return scene;
}

TEST_F(RigTest, VerticesThatOthersUseStayWhereTheyAre) {
    const Scene original = scene_with_shared_vertices();
    Scene scene = original;
    apply(R"({"light": "a", "move": [0, 0, 5]}, {"light": "a", "move": [0, 0, 1]})", scene);
    const auto position = [](const Scene& s, std::size_t triangle, std::size_t i) {
        return s.positions[s.triangles[triangle].vertex[i]];
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const Float3 before = position(original, 0, i);
        EXPECT_TRUE(same(position(scene, 0, i), {before.x, before.y, before.z + 6})) << i;
        EXPECT_TRUE(same(position(scene, 0, i), scene.lights.of<PolygonLight>()[0].vertices[i])) << i;
        EXPECT_EQ(scene.uvs[scene.triangles[0].vertex[i]].x, before.x);
        for (const std::size_t other : {1u, 2u})
            EXPECT_TRUE(same(position(scene, other, i), position(original, other, i))) << other << " " << i;
    }
    EXPECT_EQ(scene.positions.size(), 7u); // two of three are shared
    EXPECT_EQ(scene.normals.size(), 7u);
    EXPECT_EQ(scene.uvs.size(), 7u);
}

TEST_F(RigTest, SharedVerticesOutliveALight) {
    Scene scene = scene_with_shared_vertices();
    apply(R"({"light": "a", "remove": true})", scene);
    EXPECT_EQ(scene.positions.size(), 4u);
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_TRUE(same(scene.positions[scene.triangles[0].vertex[0]], {0, 0, 0}));
    EXPECT_TRUE(same(scene.positions[scene.triangles[1].vertex[2]], {2, 2, 0}));
    EXPECT_EQ(scene.triangle_light, (std::vector<std::int32_t>{0, -1}));
}

TEST_F(RigTest, ObjectsKeepTheirTriangles) {
    Scene scene = scene_with_shared_vertices();
    scene.objects = {{"leaf", 2, 1}};
    apply(R"({"light": "a", "remove": true},
             {"add": "c", "polygon": [[0, 0, 3], [1, 0, 3], [1, 1, 3], [0, 1, 3]], "radiance": 1},
             {"light": "b", "polygon": [[0, 0, 4], [1, 0, 4], [1, 1, 4]]})",
          scene);
    ASSERT_EQ(scene.objects[0].first_triangle, 3u);
    EXPECT_EQ(world_triangle_count(scene), 3u);
    EXPECT_EQ(scene.objects[0].triangle_count, 1u);
    EXPECT_TRUE(same(scene.positions[scene.triangles[3].vertex[2]], {2, 2, 0}));
    EXPECT_EQ(scene.triangle_light, (std::vector<std::int32_t>{0, 1, 1, -1}));
}

TEST_F(RigTest, MaterialsLoseTheImagesThatAreReplaced) {
    Scene scene = scene_with_shared_vertices();
    Material& wall = scene.materials[0];
    wall = {.name = "wall",
            .model = BrdfModel::frostbite,
            .diffuse_texture = {0, {2, 2}, {0, 0}},
            .f0_texture = {1, {2, 2}, {0, 0}},
            .roughness_texture = {2, {2, 2}, {0, 0}},
            .normal_texture = {3, {2, 2}, {0, 0}}};
    const auto images = [&] {
        return std::array{wall.diffuse_texture.texture, wall.f0_texture.texture,
                          wall.roughness_texture.texture, wall.normal_texture.texture};
    };
    apply_text(R"({"version": 1, "materials": [{"material": "wall", "roughness": 0.5}]})", scene);
    EXPECT_EQ(images(), (std::array{0, 1, -1, 3}));
    EXPECT_EQ(wall.roughness, 0.5f);
    apply_text(R"({"version": 1, "materials": [{"material": "wall", "diffuse": 0.25}]})", scene);
    EXPECT_EQ(images(), (std::array{-1, 1, -1, 3}));
    EXPECT_EQ(wall.diffuse.y, 0.25f);
    apply_text(R"({"version": 1, "materials": [{"material": "wall", "f0": [0.1, 0.2, 0.3]}]})", scene);
    EXPECT_EQ(images(), (std::array{-1, -1, -1, 3}));
    EXPECT_EQ(wall.f0.z, 0.3f);
}

TEST_F(RigTest, MaterialsThatBecomeGlossyTakeDefaults) {
    Scene scene = scene_with_shared_vertices();
    Material& wall = scene.materials[0];
    wall = {.name = "wall", .f0_texture = {1, {2, 2}, {0, 0}}, .roughness_texture = {2, {2, 2}, {0, 0}}};
    apply_text(R"({"version": 1, "materials": [{"material": "wall", "f0": 0.2}]})", scene);
    EXPECT_EQ(wall.f0_texture.texture, -1);
    EXPECT_EQ(wall.roughness_texture.texture, -1);
    EXPECT_EQ(wall.f0.x, 0.2f);
    EXPECT_EQ(wall.roughness, 0.5f);
}

TEST_F(RigTest, KelvinKeepsTheLuminance) {
    Scene scene = load_scene(kScenes / "room.pbrt");
    const auto luminances = [&] {
        std::vector<double> result;
        for (const PolygonLight& light : scene.lights.of<PolygonLight>())
            result.push_back(luminance(to_double(light.radiance)));
        for (const LineLight& light : scene.lights.of<LineLight>())
            result.push_back(luminance(to_double(light.radiance)));
        return result;
    };
    const std::vector<double> before = luminances();
    apply(R"({"light": "*", "kelvin": 2700})", scene);
    const std::vector<double> after = luminances();
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i], 1e-6 * before[i]);
    EXPECT_GT(scene.lights.of<PolygonLight>()[0].radiance.x,
              2 * scene.lights.of<PolygonLight>()[0].radiance.z);
}

TEST_F(RigTest, ColoursOfBlackBodiesLieOnThePlanckianLocus) {
    const auto colour_of = [this](double kelvin) {
        Scene scene;
        apply(R"({"add": "lamp", "polygon": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "radiance": 1, "kelvin": )" +
                  std::to_string(kelvin) + "}",
              scene);
        return to_double(scene.lights.of<PolygonLight>().at(0).radiance);
    };
    // Chromaticities by the tables of CIE 1931; the fit of the colour matching functions is off by a few thousandths.
    for (const auto& [kelvin, x, y] : {std::array{2000.0, 0.5267, 0.4133}, std::array{2856.0, 0.4476, 0.4074},
                                       std::array{4000.0, 0.3805, 0.3768}, std::array{6500.0, 0.3135, 0.3237},
                                       std::array{10000.0, 0.2807, 0.2884}}) {
        const Double3 rgb = colour_of(kelvin);
        EXPECT_NEAR(luminance(rgb), 1, 1e-6);
        const Double3 xyz = {dot({0.4124564, 0.3575761, 0.1804375}, rgb),
                             dot({0.2126729, 0.7151522, 0.0721750}, rgb),
                             dot({0.0193339, 0.1191920, 0.9503041}, rgb)};
        const double sum = xyz.x + xyz.y + xyz.z;
        EXPECT_NEAR(xyz.x / sum, x, 0.003) << kelvin;
        EXPECT_NEAR(xyz.y / sum, y, 0.003) << kelvin;
    }
    const Double3 ember = colour_of(1000);
    EXPECT_EQ(ember.z, 0);
    EXPECT_NEAR(luminance(ember), 1, 1e-6);
}

TEST_F(RigTest, PowerIsThatOfSceneFiles) {
    const auto scene_with = [this](const std::string& emission) {
        write("scene.pbrt", "Camera \"perspective\" WorldBegin AreaLightSource \"diffuse\" " + emission +
                                R"( Shape "line" "point3 p0" [0 0 0] "point3 p1" [2 0 0] "float radius" 0.25
                                    "bool finite" true
                                    Shape "line" "point3 p0" [0 0 9] "point3 p1" [2 0 9] "float radius" 0.25
                                    "bool finite" false
                                    Shape "polygon" "point3 P" [0 1 0  2 1 0  2 1 3])");
        return load_scene(folder_ / "scene.pbrt");
    };
    for (const char* sides : {"", " \"bool twosided\" true"}) {
        const Scene imported = scene_with("\"float power\" 7" + std::string(sides));
        Scene rigged = scene_with("\"rgb L\" [2 2 2]" + std::string(sides));
        apply(R"({"light": "*", "power": 7})", rigged);
        expect_near(rigged.lights.of<PolygonLight>().at(0).radiance,
                    imported.lights.of<PolygonLight>().at(0).radiance, 1e-6f);
        for (std::size_t i = 0; i < 2; ++i)
            expect_near(rigged.lights.of<LineLight>().at(i).radiance,
                        imported.lights.of<LineLight>().at(i).radiance, 1e-6f);
    }
}

TEST_F(RigTest, AHundredThousandLightsAreAdded) {
    Scene scene;
    apply(R"({"add": "dot", "polygon": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "radiance": 1,
              "copies": {"count": [100, 100, 10], "step": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}})",
          scene);
    EXPECT_EQ(scene.emitters.size(), 100000u);
    EXPECT_EQ(scene.emitters.back().name, "dot 99999");
    expect_near(scene.lights.of<PolygonLight>().back().vertices[0], {99, 99, 9}, 0);
}

TEST_F(RigTest, HostileFilesAreRefused) {
    EXPECT_EQ(rig_error(std::string(100000, '[')),
              "rig.json: objects and arrays are nested more than 32 deep");
    EXPECT_EQ(rig_error("{\"version\": 1, \"" + std::string(1 << 20, 'x') + "\": 1}"),
              "rig.json: unknown field \"" + std::string(39, 'x') +
                  "...; supported are version, comment, lights and materials");
    EXPECT_EQ(rig_error("{\"version\": \"" + std::string(1 << 20, 'x') + "\"}"),
              "rig.json: version: must be the number 1, found \"" + std::string(39, 'x') + "...");
    write("rig.json", "");
    std::filesystem::resize_file(folder_ / "rig.json", (256 << 20) + 1); // a hole, nothing is written
    try {
        read_rig(folder_ / "rig.json");
        ADD_FAILURE() << "is read";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(without_folder(error.what()),
                  "rig.json: has 268435457 bytes; at most 268435456 are supported");
    }
    for (const auto& [path, message] : {std::pair(folder_.path(), "a folder, not a file"),
                                        {folder_ / "missing.json", "no such file"},
                                        {std::filesystem::path("/dev/zero"),
                                         "a pipe or a device, not a file; copy its contents into a file"}}) {
        try {
            read_rig(path);
            ADD_FAILURE() << path << " is read";
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(std::string(error.what()), path.string() + ": " + message);
        }
    }
}

/// Every prefix of a good file, and files with one byte changed, are read or refused, without a crash.
TEST_F(RigTest, BrokenFilesEndInOneLine) {
    const std::string good = R"({"version": 1, "lights": [{"add": "a b", "panel": {"center": [1, 2, 3],
        "normal": [0, -1, 0], "width": 2e0, "height": 1}, "copies": {"count": [2, 1], "step": [[1, 0, 0],
        [0, 1, 0]]}, "power": 3.5, "kelvin": 4000}, {"light": "a*", "rotate": {"axis": [0, 1, 0],
        "degrees": 30}, "enabled": true}], "materials": [{"material": 0, "f0": [0, 0.5, 1]}]})";
    ASSERT_EQ(rig_error(good), "no error");
    const auto expect_one_line = [&](const std::string& text) {
        const std::string message = rig_error(text);
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_TRUE(message == "no error" || message.rfind("rig.json:", 0) == 0) << message;
    };
    for (std::size_t i = 0; i < good.size(); ++i) {
        expect_one_line(good.substr(0, i));
        constexpr char kBytes[] = {'\n', '"', '-', '9', '\x80', '\0', ','};
        std::string changed = good;
        changed[i] = kBytes[i % std::size(kBytes)];
        expect_one_line(changed);
    }
}

} // namespace
} // namespace nusselt::scene
