// Emitting sides, and the definition of emitters.

#include "scene_fixture.h"

namespace nusselt::scene {
namespace {

class EmissionSide : public SceneTest {
protected:
    Scene light(const std::string& state, const std::string& shape) const {
        return load("Camera \"perspective\"\nWorldBegin\nAreaLightSource \"diffuse\" \"rgb L\" [2 2 2]\n" +
                    state + "\n" + shape);
    }
    /// z component of the emitting side's normal; also checks that the triangles are oriented alike.
    float side(const std::string& state, const std::string& shape) const {
        const Scene scene = light(state, shape);
        EXPECT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
        const Float3 normal = emitting_normal(scene.lights.of<PolygonLight>().at(0));
        for (const Triangle& triangle : scene.triangles) {
            PolygonLight as_light;
            for (const std::uint32_t vertex : triangle.vertex)
                as_light.vertices.push_back(scene.positions[vertex]);
            expect_near(emitting_normal(as_light), normal, 1e-6f);
        }
        return normal.z;
    }
};

constexpr const char* kQuad = "Shape \"quad\" \"point o\" [0 0 0] \"vector u\" [1 0 0] \"vector v\" [0 1 0]";
constexpr const char* kPolygon = "Shape \"polygon\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0]";
constexpr const char* kMesh =
    "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] \"integer indices\" [0 1 2 0 2 3]";

TEST_F(EmissionSide, RightHandRuleInObjectSpace) {
    for (const std::string shape : {kQuad, kPolygon, kMesh}) {
        EXPECT_EQ(side("", shape), 1) << shape;
        EXPECT_EQ(side("ReverseOrientation", shape), -1) << shape;
        EXPECT_EQ(side("ReverseOrientation ReverseOrientation", shape), 1) << shape;
    }
}

TEST_F(EmissionSide, TheSideMovesWithTheObjectUnderReflections) {
    for (const std::string shape : {kQuad, kPolygon, kMesh}) {
        EXPECT_EQ(side("Scale -1 1 1", shape), 1) << shape;
        EXPECT_EQ(side("Scale 1 1 -1", shape), -1) << shape; // the vertices stay, the normal moves
        EXPECT_EQ(side("Scale -1 -1 1", shape), 1) << shape;
        EXPECT_EQ(side("Scale -1 1 1 ReverseOrientation", shape), -1) << shape;
        EXPECT_EQ(side("Rotate 180 1 0 0", shape), -1) << shape;
    }
}

TEST_F(EmissionSide, ShadingNormalsDecideIfThereAreAny) {
    const std::string up = std::string(kMesh) + " \"normal N\" [0 0 1 0 0 1 0 0 1 0 0 1]";
    const std::string down = std::string(kMesh) + " \"normal N\" [0 0 -1 0 0 -1 0 0 -1 0 0 -1]";
    EXPECT_EQ(side("", up), 1);
    EXPECT_EQ(side("", down), -1);
    EXPECT_EQ(side("ReverseOrientation", up), -1);
    EXPECT_EQ(side("Scale -1 1 1", down), -1);
    EXPECT_EQ(side("Scale 1 1 -1", up), -1); // normals move with the surface
}

TEST_F(EmissionSide, SurfacesTurnTheirNormalsToo) {
    const Scene scene =
        load("ReverseOrientation " + std::string(kMesh) + " \"normal N\" [0 0 1 0 0 1 0 0 1 0 0 1]");
    EXPECT_EQ(scene.normals[0].z, -1);
}

class Emitters : public SceneTest {};

/// Radii have no sign.
TEST(LineLights, ReflectionsKeepTheRadius) {
    LineLight light{.start = {0, 0, 0}, .end = {1, 0, 0}, .radius = 0.5f};
    LightKind<LineLight>::transform(light, scaling({-2, 2, 2}));
    EXPECT_NEAR(light.radius, 1, 1e-6f);
    EXPECT_EQ(light.end.x, -2);
    EXPECT_TRUE(LightKind<LineLight>::is_valid(light));
}

TEST_F(Emitters, RadianceIsColourTimesScale) {
    const Scene scene = load(
        "AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" 10 \"bool twosided\" true\n" +
        std::string(kTriangle) + "AreaLightSource \"diffuse\" \"color L\" [1 2 3] \"rgb scale\" [3 2 1]\n" +
        std::string(kTriangle) + "AreaLightSource \"diffuse\"\n" + std::string(kTriangle));
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 3u);
    expect_near(scene.lights.of<PolygonLight>()[0].radiance, {10, 20, 30}, 0);
    EXPECT_TRUE(scene.lights.of<PolygonLight>()[0].two_sided);
    expect_near(scene.lights.of<PolygonLight>()[1].radiance, {3, 4, 3}, 0);
    expect_near(scene.lights.of<PolygonLight>()[2].radiance, {1, 1, 1}, 0);
    EXPECT_FALSE(scene.lights.of<PolygonLight>()[2].two_sided);
}

TEST_F(Emitters, BlackOnesAreSurfaces) {
    const Scene scene = load("AreaLightSource \"diffuse\" \"rgb L\" [0 0 0]\n" + std::string(kTriangle));
    EXPECT_TRUE(scene.lights.of<PolygonLight>().empty());
    ASSERT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.triangle_light[0], -1);
}

TEST_F(Emitters, OnInvisibleSurfacesAreBlackSurfaces) {
    const Scene scene =
        load("Material \"interface\"\n" + std::string(kTriangle) + "AreaLightSource \"diffuse\"\n" +
             std::string(kTriangle) + std::string(kTriangle));
    ASSERT_EQ(scene.triangles.size(), 2u);
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].diffuse.x, 0);
    EXPECT_EQ(scene.lights.of<PolygonLight>().size(), 2u);
}

TEST_F(Emitters, ErrorsAndWarnings) {
    EXPECT_EQ(error("\nAreaLightSource \"diffuse\" \"rgb L\" [-1 0 0]"),
              "scene.pbrt:2: AreaLightSource: radiance must be from 0 to 1e+30, found -1");
    const std::string rest = "\nCamera \"perspective\"\n" + std::string(kTriangle);
    EXPECT_EQ(warning(load("AreaLightSource \"diffuse\" AreaLightSource \"laser\"" + rest)),
              "scene.pbrt:1: AreaLightSource \"laser\" is not supported; its shapes do not emit light");
    EXPECT_TRUE(load("AreaLightSource \"diffuse\" AreaLightSource \"laser\"" + rest)
                    .lights.of<PolygonLight>()
                    .empty());
    // The area of the triangle overflows nothing, but the radiance does.
    EXPECT_EQ(error("AreaLightSource \"diffuse\" \"float power\" 1e38 Scale 1e-2 1e-2 1" + rest),
              "scene.pbrt:3: AreaLightSource: radiance must be from 0 to 1e+30, found inf");
}

} // namespace
} // namespace nusselt::scene
