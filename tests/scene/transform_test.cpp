// Transform directives against positions computed by hand.

#include "scene/model/transform.h"
#include "scene_fixture.h"

namespace nusselt::scene {
namespace {

class TransformDirectives : public SceneTest {
protected:
    /// The place to which the directives move the point (1, 2, 3).
    Float3 moved(const std::string& directives) const {
        const Scene scene = load("Camera \"perspective\" WorldBegin\n" + directives +
                                 "\nShape \"trianglemesh\" \"point3 P\" [1 2 3  5 2 3  1 7 3]");
        EXPECT_TRUE(scene.warnings.empty());
        return scene.positions.at(0);
    }
};

TEST_F(TransformDirectives, Elementary) {
    expect_near(moved("Translate 10 20 30"), {11, 22, 33}, 0);
    expect_near(moved("Scale 2 -1 0.5"), {2, -2, 1.5f}, 0);
    expect_near(moved("Rotate 90 0 0 1"), {-2, 1, 3}, 1e-6f);
    expect_near(moved("Rotate 90 1 0 0"), {1, -3, 2}, 1e-6f);
    expect_near(moved("Rotate 90 0 5 0"), {3, 2, -1}, 1e-6f);
    expect_near(moved("Rotate 120 1 1 1"), {3, 1, 2}, 1e-6f);
}

TEST_F(TransformDirectives, LaterDirectivesApplyFirst) {
    expect_near(moved("Translate 10 0 0 Scale 2 2 2"), {12, 4, 6}, 0);
    expect_near(moved("Scale 2 2 2 Translate 10 0 0"), {22, 4, 6}, 0);
}

TEST_F(TransformDirectives, MatricesGoColumnByColumn) {
    const std::string matrix = "[0 1 0 0  -1 0 0 0  0 0 1 0  7 8 9 1]";
    expect_near(moved("Translate 100 0 0 Transform " + matrix), {5, 9, 12}, 0);
    expect_near(moved("Translate 100 0 0 ConcatTransform " + matrix), {105, 9, 12}, 0);
    expect_near(moved("Transform 2 0 0 0  0 2 0 0  0 0 2 0  0 0 0 2"), {1, 2, 3}, 0); // homogeneous
}

TEST_F(TransformDirectives, NamedSystems) {
    expect_near(moved("Translate 1 0 0 CoordinateSystem \"a\" Translate 5 5 5 CoordSysTransform \"a\""),
                {2, 2, 3}, 0);
    expect_near(moved("Translate 1 0 0 CoordSysTransform \"world\""), {1, 2, 3}, 0);
    expect_near(moved("Translate 1 0 0 Identity"), {1, 2, 3}, 0);
    EXPECT_EQ(error("\nCoordSysTransform \"b\""), "scene.pbrt:2: coordinate system \"b\" is not defined");
}

TEST_F(TransformDirectives, CameraSystemPlacesThingsBeforeTheCamera) {
    const Scene scene =
        load("LookAt 5 6 7  5 6 8  0 1 0 Camera \"perspective\" WorldBegin\n"
             "CoordSysTransform \"camera\" Shape \"trianglemesh\" \"point3 P\" [0 0 2 1 0 2 0 1 2]");
    expect_near(scene.positions[0], {5, 6, 9}, 1e-6f);
    expect_near(scene.positions[1], {6, 6, 9}, 1e-6f);
}

TEST_F(TransformDirectives, Impossible) {
    EXPECT_EQ(error("\nRotate 90 0 0 0"), "scene.pbrt:2: Rotate: the axis is zero");
    EXPECT_EQ(error("LookAt 0 0 0 0 1 0 0 1 0"),
              "scene.pbrt:1: LookAt: the viewing direction is zero or parallel to the up vector");
    EXPECT_EQ(error("LookAt 1 1 1 1 1 1 0 1 0"),
              "scene.pbrt:1: LookAt: the viewing direction is zero or parallel to the up vector");
    EXPECT_EQ(error("Transform [1 0 0 0 1 0]"), "scene.pbrt:1: expected a number, found ']'");
    EXPECT_EQ(error("Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0]"),
              "scene.pbrt:1: expected ']' around 16 numbers, found '0'");
}

TEST(TransformMath, InverseUndoes) {
    const Transform t = rotation(33, {1, 2, -3}) * scaling({2, -3, 0.1}) * translation({4, 5, 6});
    const auto back = inverse(t);
    ASSERT_TRUE(back);
    const Transform product = *back * t;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(product.m[i][j], i == j ? 1 : 0, 1e-13);
    EXPECT_NEAR(linear_determinant(t), -0.6, 1e-13);
    EXPECT_FALSE(inverse(scaling({1, 0, 1})));
}

TEST(TransformMath, NormalsStayOrthogonal) {
    const Transform t = rotation(20, {0, 1, 1}) * scaling({1, -4, 2}) * rotation(50, {1, 0, 0});
    const Double3 tangent = {1, 2, -1};
    const Double3 normal = {1, 0, 1};
    const Double3 world_normal = transform_normal(t, normal);
    EXPECT_NEAR(dot(world_normal, transform_vector(t, tangent)), 0, 1e-13);
    // All normals are scaled alike.
    const Double3 longer = transform_normal(t, 2.5 * normal);
    EXPECT_NEAR(length(longer - 2.5 * world_normal), 0, 1e-13);
    EXPECT_NEAR(length(transform_normal(rotation(70, {1, 2, 3}), normal)), length(normal), 1e-13);
    // The inverse transpose keeps the side even under reflection: n . v > 0 stays so.
    EXPECT_GT(dot(world_normal, transform_vector(t, {1, 5, 1})), 0);
}

} // namespace
} // namespace nusselt::scene
