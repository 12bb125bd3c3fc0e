// Shapes that become triangles: which way they face, their texture coordinates, their distance from the original.

#include "scene/model/scene_size.h"
#include "scene_fixture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nusselt::scene {
namespace {

class Tessellation : public SceneTest {
protected:
    Scene shape(const std::string& text) const { return load("Camera \"perspective\"\nWorldBegin\n" + text); }
};

Double3 right_hand_normal(const Scene& scene, const Triangle& triangle) {
    const Double3 p0 = to_double(scene.positions[triangle.vertex[0]]);
    return cross(to_double(scene.positions[triangle.vertex[1]]) - p0,
                 to_double(scene.positions[triangle.vertex[2]]) - p0);
}

/// The least cosine between the normals of triangles and a field of directions at their first vertices.
template <class Field>
double least_cosine(const Scene& scene, const Field& field) {
    double least = 1;
    for (const Triangle& triangle : scene.triangles)
        least = std::min(least, dot(normalized(right_hand_normal(scene, triangle)),
                                    normalized(field(to_double(scene.positions[triangle.vertex[0]])))));
    return least;
}

TEST_F(Tessellation, SpheresFaceOutwards) {
    const auto outwards = [](const Double3& p) { return p - Double3{1, 2, 3}; };
    const auto inwards = [&](const Double3& p) { return -1.0 * outwards(p); };
    const std::string state = "AreaLightSource \"diffuse\" Translate 1 2 3 ";
    // A sixteenth of a turn between vertices.
    const double bound = std::cos(2 * std::numbers::pi / 16);
    EXPECT_GT(least_cosine(shape(state + "Shape \"sphere\""), outwards), bound);
    EXPECT_GT(least_cosine(shape(state + "Scale -1 1 1 Shape \"sphere\""), outwards), bound);
    EXPECT_GT(least_cosine(shape(state + "ReverseOrientation Shape \"sphere\""), inwards), bound);
}

TEST_F(Tessellation, SpheresAreSmoothAndClose) {
    const Scene scene = shape("Scale 2 2 2 Shape \"sphere\" \"float radius\" 0.5");
    double largest = 0;
    double smallest = 2;
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const Double3 p = to_double(scene.positions[i]);
        largest = std::max(largest, length(p));
        expect_near(scene.normals[i], to_float(normalized(p)), 1e-6f);
        // Pbrt's parameters: u is the azimuth, v the angle from the lower pole.
        const double v = 1 - std::acos(std::clamp(p.z / length(p), -1.0, 1.0)) / std::numbers::pi;
        EXPECT_NEAR(scene.uvs[i].y, v, 1e-3);
    }
    for (const Triangle& t : scene.triangles) {
        const Double3 centroid =
            (1.0 / 3) * (to_double(scene.positions[t.vertex[0]]) + to_double(scene.positions[t.vertex[1]]) +
                         to_double(scene.positions[t.vertex[2]]));
        smallest = std::min(smallest, length(centroid));
    }
    // The sagitta of an arc of 1 / 64 of a turn is 1 - cos(pi / 64) = 0.0012.
    EXPECT_LT(largest, 1.0012);
    EXPECT_GT(smallest, 0.9976);
}

TEST_F(Tessellation, DisksFaceAlongTheirAxis) {
    const auto up = [](const Double3&) { return Double3{0, 0, 1}; };
    const std::string disk = "Shape \"disk\" \"float innerradius\" 0.5 \"float height\" 2";
    const Scene scene = shape("AreaLightSource \"diffuse\" " + disk);
    EXPECT_GT(least_cosine(scene, up), 1 - 1e-6);
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const Float3& p = scene.positions[i];
        EXPECT_EQ(p.z, 2);
        // u is the azimuth, v runs from the rim inwards.
        EXPECT_NEAR(std::hypot(p.x, p.y), 1 - 0.5 * scene.uvs[i].y, 0.01);
        EXPECT_NEAR(std::cos(2 * std::numbers::pi * static_cast<double>(scene.uvs[i].x)),
                    p.x / std::hypot(p.x, p.y), 1e-5);
    }
    EXPECT_LT(least_cosine(shape("AreaLightSource \"diffuse\" ReverseOrientation " + disk), up), -1 + 1e-6);
}

TEST_F(Tessellation, CylindersFaceAwayFromTheirAxis) {
    const auto outwards = [](const Double3& p) { return Double3{p.x, p.y, 0}; };
    const Scene scene =
        shape("AreaLightSource \"diffuse\" Shape \"cylinder\" \"float phimax\" 180 \"float zmax\" 3");
    EXPECT_GT(least_cosine(scene, outwards), std::cos(2 * std::numbers::pi / 16));
    const auto [low, high] = std::minmax_element(scene.positions.begin(), scene.positions.end(),
                                                 [](const auto& a, const auto& b) { return a.z < b.z; });
    EXPECT_EQ(low->z, -1);
    EXPECT_EQ(high->z, 3);
}

TEST_F(Tessellation, ManyRoundShapesAreCoarser) {
    const auto spheres = [&](int count) {
        std::string text;
        for (int i = 0; i < count; ++i) text += "Shape \"sphere\"\n";
        return shape(text).triangles.size() / static_cast<std::size_t>(count);
    };
    EXPECT_EQ(spheres(1000), 2u * 64 * 32 - 2 * 64);
    EXPECT_EQ(spheres(4000), 2u * 32 * 16 - 2 * 32);
    EXPECT_EQ(spheres(70000), 2u * 8 * 4 - 2 * 8);
}

TEST_F(Tessellation, CurvedPatchesStayWithinTheirTolerance) {
    const Scene scene = shape("Shape \"bilinearmesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0  1 1 1]");
    // The patch is z = x y, its longest side sqrt(2).
    for (const Triangle& t : scene.triangles) {
        const Double3 middle =
            0.5 * (to_double(scene.positions[t.vertex[0]]) + to_double(scene.positions[t.vertex[2]]));
        EXPECT_NEAR(middle.z, middle.x * middle.y, 1e-3 * std::numbers::sqrt2);
    }
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const Float3& p = scene.positions[i];
        EXPECT_NEAR(p.z, p.x * p.y, 1e-6);
        EXPECT_EQ(scene.uvs[i].x, p.x);
        expect_near(scene.normals[i], to_float(normalized({-p.y, -p.x, 1})), 1e-5f);
    }
}

TEST_F(Tessellation, PatchesFaceFromUToV) {
    const auto up = [](const Double3&) { return Double3{0, 0, 1}; };
    const std::string light = "AreaLightSource \"diffuse\" ";
    const std::string flat = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0  1 1 0]";
    const std::string curved = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0  1 1 0.1]";
    EXPECT_GT(least_cosine(shape(light + flat), up), 0.9);
    EXPECT_GT(least_cosine(shape(light + curved), up), 0.9);
    EXPECT_LT(least_cosine(shape(light + flat + " \"normal N\" [0 0 -1 0 0 -1 0 0 -1 0 0 -1]"), up), -0.9);
}

class EmitterTest : public SceneTest {};

TEST_F(EmitterTest, NamesAreRelativeToTheSceneAndUnique) {
    write("parts/lamp.inc", "\n" + std::string(kTriangle) + std::string(kTriangle));
    const Scene scene = load("AreaLightSource \"diffuse\"\n" + std::string(kTriangle) +
                             "Include \"parts/lamp.inc\" Include \"parts/lamp.inc\"");
    std::vector<std::string> names;
    for (const Emitter& emitter : scene.emitters) names.push_back(emitter.name);
    EXPECT_EQ(names, (std::vector<std::string>{
                         "trianglemesh at scene.pbrt:2", "trianglemesh at parts/lamp.inc:2",
                         "trianglemesh at parts/lamp.inc:3", "trianglemesh at parts/lamp.inc:2 #2",
                         "trianglemesh at parts/lamp.inc:3 #2"}));
}

TEST_F(EmitterTest, InvisibleOnesCountForTheSizeOfTheScene) {
    const Scene scene = load("AreaLightSource \"diffuse\" Shape \"quad\" \"point o\" [0 0 0] "
                             "\"vector u\" [3 0 0] \"vector v\" [0 4 0] \"float alpha\" 0");
    EXPECT_TRUE(scene.triangles.empty());
    EXPECT_EQ(scene.radius, 2.5);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[0]).z, 1);
}

TEST_F(EmitterTest, TrianglesKeepTheirPlaceWhenMeshesAreJoined) {
    // Meshes with and without normals, surfaces and lights in turns.
    const std::string far =
        "Shape \"trianglemesh\" \"point3 P\" [5 0 0 6 0 0 5 1 0] \"point2 uv\" [0 0 1 0 0 1]\n";
    const Scene scene =
        load("AttributeBegin AreaLightSource \"diffuse\"\n" + std::string(kTriangle) + "AttributeEnd\n" +
             far + "AreaLightSource \"diffuse\" \"rgb L\" [2 2 2]\n" + std::string(kTriangle) + far);
    ASSERT_EQ(scene.triangles.size(), 4u);
    EXPECT_EQ(scene.triangle_light, (std::vector<std::int32_t>{0, -1, 1, 2}));
    EXPECT_EQ(scene.triangles[3].vertex[2], 11u);
    EXPECT_EQ(scene.positions[10].x, 6);
    EXPECT_EQ(scene.uvs[10].x, 1);
    EXPECT_EQ(scene.uvs[7].x, 0);
    EXPECT_EQ(scene.lights.of<PolygonLight>()[2].radiance.x, 2);
    EXPECT_EQ(scene.lights.of<PolygonLight>()[2].emitter, 2u);
}

TEST_F(EmitterTest, SizesAreThoseOfTheArrays) {
    const Scene scene = load(std::string(kTriangle));
    // Three vertices with normal and texture coordinates, a triangle with its material and light, one material.
    EXPECT_EQ(array_bytes(scene), 3 * 32u + 20u + sizeof(Material));
}

} // namespace
} // namespace nusselt::scene
