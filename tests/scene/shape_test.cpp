// Shapes of scene files and their errors.

#include "scene_fixture.h"

#include <cmath>

namespace nusselt::scene {
namespace {

class Shapes : public SceneTest {
protected:
    Scene shapes(const std::string& text) const {
        return load("Camera \"perspective\"\nWorldBegin\n" + text);
    }
};

TEST_F(Shapes, TriangleMeshWithEverything) {
    const Scene scene = shapes(R"(
        Translate 0 0 5
        Shape "trianglemesh" "point P" [0 0 0 1 0 0 1 1 0 0 1 0] "normal N" [0 0 2 0 0 1 0 0 1 0 0 1]
              "point2 uv" [0 0 1 0 1 1 0 1] "integer indices" [0 1 2 2 3 0])");
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.triangles.size(), 2u);
    ASSERT_EQ(scene.positions.size(), 4u);
    EXPECT_EQ(scene.triangles[1].vertex[0], 2u);
    EXPECT_EQ(scene.triangles[1].vertex[2], 0u);
    expect_near(scene.positions[2], {1, 1, 5}, 0);
    expect_near(scene.normals[0], {0, 0, 2}, 1e-6f);
    EXPECT_EQ(scene.uvs[2].x, 1);
    EXPECT_EQ(scene.triangle_light[0], -1);
    EXPECT_NEAR(scene.radius, std::sqrt(0.5), 1e-6);
}

TEST_F(Shapes, TextureCoordinatesUnderTheirOldNames) {
    for (const std::string name : {"float uv", "float st", "point2 st"}) {
        const Scene scene =
            shapes(R"(Shape "trianglemesh" "point P" [0 0 0 1 0 0 1 1 0] ")" + name + "\" [0 0 1 0 1 1]");
        EXPECT_TRUE(scene.warnings.empty());
        EXPECT_EQ(scene.uvs[1].x, 1) << name;
    }
}

TEST_F(Shapes, MeshesAreJoined) {
    const Scene scene = shapes(std::string(kTriangle) + R"(
        AreaLightSource "diffuse" "rgb L" [1 2 3]
        Shape "trianglemesh" "point3 P" [0 0 1 1 0 1 0 1 1]  "normal N" [0 0 1 0 0 1 0 0 1]
        Shape "trianglemesh" "point3 P" [0 0 2 1 0 2 0 1 2])");
    ASSERT_EQ(scene.triangles.size(), 3u);
    EXPECT_EQ(scene.normals.size(), scene.positions.size());
    EXPECT_EQ(scene.uvs.size(), scene.positions.size());
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(scene.triangles[i].vertex[1], 3 * i + 1);
        EXPECT_EQ(scene.triangle_light[i], static_cast<int>(i) - 1);
        EXPECT_EQ(scene.triangle_material[i], 0u);
    }
    EXPECT_EQ(scene.normals[0].z, 0); // none given
    EXPECT_EQ(scene.normals[3].z, 1);
    EXPECT_EQ(scene.lights.of<PolygonLight>()[1].vertices[0].z, 2);
    EXPECT_EQ(scene.lights.of<PolygonLight>()[1].radiance.z, 3);
}

TEST_F(Shapes, TriangleMeshErrors) {
    EXPECT_EQ(error("\nShape \"trianglemesh\""),
              "scene.pbrt:2: shape \"trianglemesh\": parameter \"point3 P\" is missing");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0]"),
              "scene.pbrt:1: shape \"trianglemesh\": parameter \"integer indices\" is missing");
    EXPECT_EQ(
        error("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n\"integer indices\" [0 1 2 2 3 0]"),
        "scene.pbrt:2: parameter \"integer indices\": index 3 at position 4 must be an integer from 0 to 3 - "
        "1, "
        "the number of vertices");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 -2]"),
              "scene.pbrt:1: parameter \"integer indices\": index -2 at position 2 must be an integer from 0 "
              "to 3 - 1, "
              "the number of vertices");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2 0]"),
              "scene.pbrt:1: shape \"trianglemesh\": the number of indices, 4, must be a multiple of 3");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n\n\"normal N\" [0 0 1]"),
              "scene.pbrt:3: shape \"trianglemesh\": 1 values of \"N\" for 3 vertices");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"float uv\" [0 0 1]"),
              "scene.pbrt:1: parameter \"float uv\": expected pairs, found 3 numbers");
}

TEST_F(Shapes, HugeCoordinatesAreRefused) {
    EXPECT_EQ(error("\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 2e15 0]"),
              "scene.pbrt:2: shape \"trianglemesh\": vertex 2 at (0, 1999999973982208, 0) must be finite and "
              "within 1e15 m");
    EXPECT_EQ(
        error("Scale 1e30 1 1 Shape \"trianglemesh\" \"point3 P\" [0 0 0 1e30 0 0 0 1 0]"),
        "scene.pbrt:1: shape \"trianglemesh\": vertex 1 at (inf, 0, 0) must be finite and within 1e15 m");
    // A perspective transform that sends a vertex to infinity.
    EXPECT_EQ(error("Transform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 0] Shape \"trianglemesh\" \"point3 P\" [0 0 0 "
                    "1 0 0 0 1 0]")
                  .substr(0, 47),
              "scene.pbrt:1: shape \"trianglemesh\": vertex 0 at");
}

TEST_F(Shapes, DegenerateTrianglesAreLeftOut) {
    const Scene scene = shapes(R"(
        Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0 2 0 0] "integer indices" [0 1 2 0 1 3 0 0 1 2 2 2]
        Shape "trianglemesh" "point3 P" [0 0 0 0 0 0 0 0 0])");
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(warning(scene), "scene.pbrt:4: 4 degenerate triangles are skipped, starting here");
}

TEST_F(Shapes, BrokenNormalsBecomeNone) {
    const Scene scene = shapes(R"(Scale 2 2 2 Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0]
                                  "normal N" [0 0 0 1e38 1e38 1e38 0 0 3])");
    expect_near(scene.normals[0], {0, 0, 0}, 0);
    expect_near(scene.normals[1], {0, 0, 0}, 0);
    expect_near(scene.normals[2], {0, 0, 3}, 1e-6f);
}

TEST_F(Shapes, Quad) {
    const Scene scene =
        shapes("AreaLightSource \"diffuse\" Shape \"quad\" \"point o\" [1 2 3] \"vector u\" [2 0 0] "
               "\"vector v\" [0 0 -1]");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.triangles.size(), 2u);
    expect_near(scene.positions[2], {3, 2, 2}, 0);
    EXPECT_EQ(scene.uvs[2].y, 1);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    ASSERT_EQ(scene.lights.of<PolygonLight>()[0].vertices.size(), 4u);
    expect_near(emitting_normal(scene.lights.of<PolygonLight>()[0]), {0, 1, 0}, 1e-6f); // u x v
    EXPECT_EQ(
        error("\nShape \"quad\" \"point o\" [0 0 0] \"vector u\" [1 0 0]"),
        "scene.pbrt:2: shape \"quad\": must have the parameters \"point o\", \"vector u\" and \"vector v\"");
}

TEST_F(Shapes, Polygon) {
    const Scene scene = shapes("AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] "
                               "Shape \"polygon\" \"point3 P\" [0 0 0 2 0 0 3 1 0 2 2 0 0 2 0]");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.triangles.size(), 3u);
    ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
    EXPECT_EQ(scene.lights.of<PolygonLight>()[0].vertices.size(), 5u);
    for (const int light : scene.triangle_light) EXPECT_EQ(light, 0);
    EXPECT_EQ(scene.emitters[scene.lights.of<PolygonLight>()[0].emitter].name.substr(0, 11), "polygon at ");
    EXPECT_EQ(shapes("Shape \"polygon\" \"point3 P\" [0 0 0 2 0 0 3 1 0 2 2 0]").triangles.size(), 2u);
}

TEST_F(Shapes, PolygonErrors) {
    const auto polygon = [](const std::string& vertices) {
        return "\nShape \"polygon\"\n\"point3 P\" [" + vertices + "]";
    };
    const std::string begin = "scene.pbrt:3: shape \"polygon\": ";
    EXPECT_EQ(error("\nShape \"polygon\""),
              "scene.pbrt:2: shape \"polygon\": it must have 3 to 8 vertices, found 0");
    EXPECT_EQ(error(polygon("0 0 0 1 0 0")), begin + "it must have 3 to 8 vertices, found 2");
    EXPECT_EQ(error(polygon("4 0 0 3 1 0 2 2 0 1 3 0 0 4 0 -1 3 0 -2 2 0 -1 1 0 0 0 0")),
              begin + "it must have 3 to 8 vertices, found 9");
    // Any vertex of a quad can be blamed, and the last one is: 0.4 / sqrt(1 + 0.4^2).
    EXPECT_EQ(error(polygon("0 0 0 1 0 0 1 1 0.4 0 1 0")).substr(0, begin.size() + 17),
              begin + "vertex 3 is 0.371");
    EXPECT_EQ(error(polygon("0 0 0 2 0 0 3 1 0.25 2 2 0 0 2 0")),
              begin + "vertex 2 is 0.25 m away from the plane of the others");
    // Vertex 3 lies beyond the line through 1 and 2, which turns inwards at 2.
    EXPECT_EQ(error(polygon("0 0 0 4 0 0 1 1 0 0 4 0")),
              begin +
                  "it is not convex: vertex 3 is 2.529822128134703 m outside the edge from vertex 1 to 2");
    // A pentagram turns left at each corner.
    EXPECT_NE(error(polygon("0 1 0 -0.588 -0.809 0 0.951 0.309 0 -0.951 0.309 0 0.588 -0.809 0"))
                  .find("not convex"),
              std::string::npos);
    EXPECT_EQ(error(polygon("0 0 0 1 0 0 1 0 0 0 1 0")), begin + "vertices 1 and 2 coincide");
    EXPECT_EQ(error(polygon("0 0 0 1 0 0 2 0 0")), begin + "its area is zero");
}

TEST_F(Shapes, PolygonsFarFromTheOriginAreToleratedWithinRounding) {
    const Scene scene =
        shapes("Shape \"polygon\" \"point3 P\" [1000 1000.0001 0 1001 1000 0 1001 1001 0.0001 1000 1001 0]");
    EXPECT_EQ(scene.triangles.size(), 2u);
}

TEST_F(Shapes, Line) {
    const Scene scene =
        shapes("AttributeBegin Translate 1 0 0 Scale 2 2 2 AreaLightSource \"diffuse\" \"rgb L\" [5 6 7]\n"
               "Shape \"line\" \"point3 p0\" [0 0 1] \"point3 p1\" [0 3 1] \"float radius\" 0.01\n"
               "Shape \"line\" \"point3 P\" [0 0 0 1 0 0] \"float radius\" 0.02 AttributeEnd\n");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_TRUE(scene.triangles.empty());
    ASSERT_EQ(scene.lights.of<LineLight>().size(), 2u);
    const LineLight& line = scene.lights.of<LineLight>()[0];
    expect_near(line.start, {1, 0, 2}, 0);
    expect_near(line.end, {1, 6, 2}, 0);
    EXPECT_NEAR(line.radius, 0.02, 1e-8);
    EXPECT_EQ(line.radiance.z, 7);
    expect_near(scene.lights.of<LineLight>()[1].end, {3, 0, 0}, 0);
    EXPECT_NEAR(scene.lights.of<LineLight>()[1].radius, 0.04, 1e-8);
    // Bounding box from (0.96, -0.04, -0.04) to (3.04, 6.02, 2.02).
    EXPECT_NEAR(scene.radius, 0.5 * std::sqrt(2.08 * 2.08 + 6.06 * 6.06 + 2.06 * 2.06), 1e-6);
}

TEST_F(Shapes, LineErrors) {
    EXPECT_EQ(
        error("\nShape \"line\" \"point3 p0\" [0 0 0] \"float radius\" 1"),
        "scene.pbrt:2: shape \"line\": must have the parameters \"point3 p0\", \"point3 p1\" and \"float "
        "radius\"");
    EXPECT_EQ(error("Shape \"line\" \"point3 P\" [0 0 0 1 0 0]"),
              "scene.pbrt:1: shape \"line\": radius must be positive, found 0");
    EXPECT_EQ(error("Shape \"line\" \"point3 P\" [0 0 0 1 0 0]\n\"float radius\" -1"),
              "scene.pbrt:2: shape \"line\": radius must be positive, found -1");
    EXPECT_EQ(error("Shape \"line\" \"point3 P\" [1 0 0 1 0 0] \"float radius\" 1"),
              "scene.pbrt:1: shape \"line\": the end points must differ");
    EXPECT_EQ(error("Shape \"line\" \"point3 P\" [1e16 0 0 1 0 0] \"float radius\" 1"),
              "scene.pbrt:1: shape \"line\": the end points must be finite and within 1e15 m");
    const Scene dark = load("Camera \"perspective\"\n" + std::string(kTriangle) +
                            "Shape \"line\" \"point3 P\" [0 0 0 1 0 0] \"float radius\" 1");
    EXPECT_TRUE(dark.lights.of<LineLight>().empty());
    EXPECT_EQ(warning(dark), "scene.pbrt:3: shape \"line\": skipped because it does not emit light");
}

TEST_F(Shapes, FiniteLine) {
    const std::string line = "AreaLightSource \"diffuse\" \"rgb L\" [5 6 7]\n"
                             "Shape \"line\" \"point3 P\" [0 0 0 1 0 0] \"float radius\" 0.5 ";
    EXPECT_EQ(shapes(line).lights.of<LineLight>().at(0).model, TubeModel::solid);
    EXPECT_EQ(shapes(line + "\"bool finite\" false").lights.of<LineLight>().at(0).model, TubeModel::linear);
    const Scene scene = shapes(line + "\"bool finite\" true");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.lights.of<LineLight>().at(0).model, TubeModel::solid);
    EXPECT_EQ(scene.lights.of<LineLight>().at(0).radius, 0.5f);
}

TEST_F(Shapes, LineWithDarkCaps) {
    const std::string line = "AreaLightSource \"diffuse\" \"rgb L\" [5 6 7]\n"
                             "Shape \"line\" \"point3 P\" [0 0 0 1 0 0] \"float radius\" 0.5 ";
    const auto model = [&](const std::string& parameters) {
        const Scene scene = shapes(line + parameters);
        EXPECT_TRUE(scene.warnings.empty());
        return scene.lights.of<LineLight>().at(0).model;
    };
    EXPECT_EQ(model("\"string caps\" \"bright\""), TubeModel::solid);
    EXPECT_EQ(model("\"string caps\" \"dark\""), TubeModel::open);
    EXPECT_EQ(model("\"bool finite\" false \"string caps\" \"dark\""), TubeModel::linear);
    const auto message = [&](const std::string& parameters) { return error(line + parameters); };
    EXPECT_EQ(message("\"string caps\" \"black\""),
              "scene.pbrt:2: shape \"line\": caps must be \"bright\" or \"dark\", found \"black\"");
    EXPECT_EQ(message("\"bool finite\" false \"string caps\" \"bright\""),
              "scene.pbrt:2: shape \"line\": a tube with \"bool finite\" false has no caps");
}

TEST_F(Shapes, LineWithNormal) {
    const std::string line = "AreaLightSource \"diffuse\" \"rgb L\" [5 6 7]\n"
                             "Shape \"line\" \"point3 P\" [0 0 0 1 0 0] ";
    const Scene scene =
        shapes("Rotate 90 0 0 1 Scale 2 2 2\n" + line + "\"normal N\" [4 0 3] \"float width\" 0.5");
    EXPECT_TRUE(scene.warnings.empty());
    const LineLight& strip = scene.lights.of<LineLight>().at(0);
    EXPECT_EQ(strip.model, TubeModel::strip);
    expect_near(strip.end, {0, 2, 0}, 1e-6f);
    expect_near(strip.normal, {0, 0, 1}, 1e-6f);
    EXPECT_NEAR(strip.radius, 0.5, 1e-6);
    EXPECT_EQ(error(line + "\"normal N\" [0 0 3] \"float radius\" 0.5"),
              "scene.pbrt:2: shape \"line\": width must be positive, found 0");
    EXPECT_EQ(error(line + "\"normal N\" [1 0 0] \"float width\" 0.5"),
              "scene.pbrt:2: shape \"line\": the normal N must not be parallel to the line");
}

TEST_F(Shapes, Cylinder) {
    const Scene scene = shapes(
        "AttributeBegin Translate 1 0 0 Rotate 90 0 1 0 Scale 2 2 3 AreaLightSource \"diffuse\" \"rgb L\" "
        "[5 6 7]\n"
        "Shape \"cylinder\" \"float radius\" 0.25 \"float zmin\" 0 \"float zmax\" 2 \"float phimax\" 360\n"
        "Shape \"cylinder\" AttributeEnd\n");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_TRUE(scene.triangles.empty());
    ASSERT_EQ(scene.lights.of<LineLight>().size(), 2u);
    const LineLight& tube = scene.lights.of<LineLight>()[0];
    EXPECT_EQ(tube.model, TubeModel::solid);
    expect_near(tube.start, {1, 0, 0}, 1e-6f);
    expect_near(tube.end, {7, 0, 0}, 1e-6f);
    EXPECT_NEAR(tube.radius, 0.5, 1e-7);
    EXPECT_EQ(tube.radiance.y, 6);
    EXPECT_EQ(scene.emitters[tube.emitter].name.substr(0, 12), "cylinder at ");
    // The defaults of pbrt.
    expect_near(scene.lights.of<LineLight>()[1].start, {-2, 0, 0}, 1e-6f);
    expect_near(scene.lights.of<LineLight>()[1].end, {4, 0, 0}, 1e-6f);
    EXPECT_NEAR(scene.lights.of<LineLight>()[1].radius, 2, 1e-6);
}

TEST_F(Shapes, CylinderErrors) {
    const std::string light = "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n";
    EXPECT_EQ(error(light + "Shape \"cylinder\" \"float radius\" -1"),
              "scene.pbrt:2: shape \"cylinder\": radius must be positive, found -1");
    EXPECT_NE(
        error(light + "Shape \"cylinder\" \"float radius\" 1e20").find("at most 1e15 m after the transform"),
        std::string::npos);
    EXPECT_EQ(error(light + "Shape \"cylinder\" \"float zmin\" 1"),
              "scene.pbrt:2: shape \"cylinder\": the end points must differ");
    EXPECT_EQ(warning(shapes(light + "ReverseOrientation Shape \"cylinder\"")),
              "scene.pbrt:4: shape \"cylinder\": ReverseOrientation is ignored; tubes emit outwards");
}

TEST_F(Shapes, CylindersThatAreNoTubesBecomeSurfaces) {
    const std::string light = "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n";
    for (const std::string cylinder :
         {"Shape \"cylinder\" \"float phimax\" 180", "Scale 1 2 1 Shape \"cylinder\"",
          "ConcatTransform [1 0 0 0 0 1 0 0 0.5 0 1 0 0 0 0 1] Shape \"cylinder\""}) {
        const Scene scene = shapes(light + cylinder);
        EXPECT_TRUE(scene.lights.of<LineLight>().empty()) << cylinder;
        EXPECT_GE(scene.lights.of<PolygonLight>().size(), 8u) << cylinder;
    }
    EXPECT_TRUE(shapes("Shape \"cylinder\"").lights.of<PolygonLight>().empty());
}

} // namespace
} // namespace nusselt::scene
