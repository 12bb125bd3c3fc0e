// Objects, their instances, and lights inside them.

#include "scene/build/placed_shape.h"
#include "scene_fixture.h"

#include <cmath>

namespace nusselt::scene {
namespace {

class Objects : public SceneTest {
protected:
    /// Definitions of one triangle each.
    static std::string define(const std::string& name, const std::string& inside = "") {
        return "ObjectBegin \"" + name + "\"\n" + inside + std::string(kTriangle) + "ObjectEnd\n";
    }
};

TEST_F(Objects, ComeAfterTheTrianglesOfTheWorld) {
    const Scene scene =
        load("Camera \"perspective\"\n" + define("a") + std::string(kTriangle) + define("unused") +
             define("b", std::string(kTriangle)) + "ObjectInstance \"b\"\n" + std::string(kTriangle) +
             "ObjectInstance \"a\" ObjectInstance \"b\"\n");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(world_triangle_count(scene), 2u);
    ASSERT_EQ(scene.triangles.size(), 5u);
    EXPECT_EQ(scene.triangle_light, std::vector<std::int32_t>(5, -1));
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].name, "a");
    EXPECT_EQ(scene.objects[0].first_triangle, 2u);
    EXPECT_EQ(scene.objects[0].triangle_count, 1u);
    EXPECT_EQ(scene.objects[1].name, "b");
    EXPECT_EQ(scene.objects[1].first_triangle, 3u);
    EXPECT_EQ(scene.objects[1].triangle_count, 2u);
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[0].object, 1u);
    EXPECT_EQ(scene.instances[1].object, 0u);
    EXPECT_EQ(scene.instances[2].object, 1u);
}

TEST_F(Objects, TransformsOfDefinitionAndInstanceStayApart) {
    const Scene scene = load("Camera \"perspective\"\n" + define("a", "Translate 5 6 7\n") +
                             "Translate 1 2 3 Scale 2 -3 4\nObjectInstance \"a\"\n");
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].world_from_object,
              (std::array<float, 12>{2, 0, 0, 1, 0, -3, 0, 2, 0, 0, 4, 3}));
    expect_near(scene.positions.at(0), {5, 6, 7}, 0);
}

TEST_F(Objects, EmptyOnesLeaveNoGap) {
    const Scene scene = load("Camera \"perspective\"\nObjectBegin \"none\" ObjectEnd\n" + define("a") +
                             "ObjectInstance \"none\" ObjectInstance \"a\" ObjectInstance \"none\"\n");
    ASSERT_EQ(scene.objects.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].object, 0u);
    EXPECT_EQ(world_triangle_count(scene), 0u);
}

TEST_F(Objects, RadiusCountsInstancesAndNotDefinitions) {
    const std::string far = "ObjectBegin \"a\" Translate 1000 0 0\n" + std::string(kTriangle) + "ObjectEnd\n";
    const Scene scene = load(far + "Translate -1000 0 0 Scale 1 1 1\nObjectInstance \"a\"\nTranslate 3 3 0\n"
                                   "ObjectInstance \"a\"\n");
    // The box from (0, 0, 0) to (4, 4, 0).
    EXPECT_NEAR(scene.radius, 2 * std::sqrt(2.0), 1e-5);
}

TEST_F(Objects, LightsAreCopiedToTheWorld) {
    const Scene scene =
        load("Camera \"perspective\"\nObjectBegin \"lamp\" Translate 0 0 1\n" + std::string(kTriangle) +
             "AreaLightSource \"diffuse\" \"rgb L\" [1 2 3]\n" + std::string(kTriangle) +
             "ObjectEnd\nTranslate 10 0 0\nObjectInstance \"lamp\"\nScale -2 2 2\nObjectInstance "
             "\"lamp\"\n");
    EXPECT_EQ(world_triangle_count(scene), 2u);
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].triangle_count, 1u);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 2u);
    EXPECT_EQ(scene.lights.of<PolygonLight>()[1].emitter, 1u);
    EXPECT_EQ(scene.triangle_light[0], 0);
    EXPECT_EQ(scene.triangle_light[1], 1);
    expect_near(scene.positions.at(0), {10, 0, 1}, 0);
    expect_near(scene.positions.at(4), {8, 0, 2}, 0);
    // Reflections move the emitting side too, as in pbrt.
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[0]).z, 1);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[1]).z, 1);
}

TEST_F(Objects, CylindersThatInstancesFlattenAreBlackSurfacesThatEmit) {
    const Scene scene = load("Camera \"perspective\"\n" + std::string(kTriangle) +
                             "ObjectBegin \"lamp\" AreaLightSource \"diffuse\" Shape \"cylinder\" ObjectEnd\n"
                             "ObjectInstance \"lamp\" Translate 5 0 0 Scale 1 2 1 ObjectInstance \"lamp\"\n");
    EXPECT_EQ(scene.lights.of<LineLight>().size(), 1u);
    EXPECT_EQ(scene.lights.of<PolygonLight>().size(), 16u);
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[1].name, "black");
    expect_near(scene.materials[1].diffuse, {0, 0, 0}, 0);
    EXPECT_EQ(scene.triangle_material.front(), 0u);
    EXPECT_EQ(scene.triangle_material.back(), 1u);
}

TEST_F(Objects, CopiesOfLargeLightsAreLimited) {
    std::string points;
    for (int i = 0; i < 30000; ++i) points += "0 0 0 1 0 0 0 1 0 ";
    std::string indices;
    for (int i = 0; i < 90000; ++i) indices += std::to_string(i) + ' ';
    std::string text =
        "ObjectBegin \"lamp\" AreaLightSource \"diffuse\" Shape \"trianglemesh\" \"point3 P\" [" + points +
        "] \"integer indices\" [" + indices + "] ObjectEnd\n";
    for (int i = 0; i < 1000; ++i) text += "ObjectInstance \"lamp\"\n";
    // 360000 numbers each, 2^26 in all.
    EXPECT_EQ(error(text),
              "scene.pbrt:188: instances have more than 131072 shapes that emit light, or more than "
              "67108864 numbers in these; move lights out of objects");
}

TEST(InstanceRows, NeedAnAffineInverse) {
    EXPECT_TRUE(instance_rows({}));
    EXPECT_TRUE(instance_rows(scaling({1e-10, 1e10, -1})));
    EXPECT_FALSE(instance_rows(scaling({1e-16, 1, 1})));
    EXPECT_FALSE(instance_rows(scaling({1e16, 1, 1})));
    EXPECT_FALSE(instance_rows(scaling({0, 1, 1})));
    EXPECT_FALSE(instance_rows(translation({0, 2e15, 0})));
    Transform projective;
    projective.m[3][0] = 1;
    EXPECT_FALSE(instance_rows(projective));
    Transform homogeneous = translation({2, 4, 6});
    homogeneous.m[3][3] = 0.5;
    EXPECT_EQ(instance_rows(homogeneous), (std::array<float, 12>{2, 0, 0, 4, 0, 2, 0, 8, 0, 0, 2, 12}));
}

} // namespace
} // namespace nusselt::scene
