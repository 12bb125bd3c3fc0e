// Shapes that emit an image: which part of it each light has, and when it is replaced by a mean.

#include "scene_fixture.h"

#include "image/io.h"

#include <algorithm>

namespace nusselt::scene {
namespace {

class ImageEmission : public SceneTest {
protected:
    ImageEmission() { write_ramp("ramp.pfm", 8, 4); }

    /// An image whose texels are (column, row, 1), with row 0 at the bottom.
    void write_ramp(const std::string& name, int width, int height) const {
        image::Image image = image::make_image(width, height);
        for (int j = 0; j < height; ++j) {
            for (int i = 0; i < width; ++i) {
                float* const pixel = &image.pixels[3 * static_cast<std::size_t>(j * width + i)];
                pixel[0] = static_cast<float>(i);
                pixel[1] = static_cast<float>(height - 1 - j);
                pixel[2] = 1;
            }
        }
        image::write_image(folder_ / name, image);
    }

    Scene light(const std::string& shape, const std::string& emission = "") const {
        return load("Camera \"perspective\"\nWorldBegin\nAreaLightSource \"diffuse\" \"string filename\" "
                    "\"ramp.pfm\" " +
                    emission + "\n" + shape);
    }
};

const std::vector<PolygonLight>& polygons(const Scene& scene) { return scene.lights.of<PolygonLight>(); }

constexpr const char* kQuad = "Shape \"quad\" \"point o\" [0 0 0] \"vector u\" [2 0 0] \"vector v\" [0 1 0]";

std::string mesh(const std::string& uv) {
    return "Shape \"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 2 1 0 0 1 0] \"integer indices\" [0 1 2 0 2 "
           "3] " +
           (uv.empty() ? "" : "\"point2 uv\" [" + uv + "]");
}

TEST_F(ImageEmission, EqualPartsAreShared) {
    const std::string part = "\"point2 uv\" [0.1 0.2 0.4 0.2 0.4 0.7]\n";
    const std::string other = "\"point2 uv\" [0.1 0.2 0.4 0.2 0.4 0.8]\n";
    const auto triangle = [](const std::string& points) {
        return "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [" + points + "] ";
    };
    const Scene scene =
        light(triangle("0 0 0 1 0 0 1 1 0") + part + triangle("0.3 7.1 0.7 1.9 7.3 0 1.7 8.1 0.9") + part +
              triangle("0 0 3 1 0 3 1 1 3") + other);
    ASSERT_EQ(scene.emission_textures.size(), 3u);
    const auto& [first, second, third] =
        std::tie(scene.emission_textures[0], scene.emission_textures[1], scene.emission_textures[2]);
    EXPECT_EQ(first.texture, second.texture);
    expect_near(first.mean, second.mean, 0);
    EXPECT_NE(first.texture, third.texture);
}

TEST_F(ImageEmission, ARectangleHasTheWholeImage) {
    const Scene scene = light(kQuad, "\"float scale\" 2");
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(polygons(scene).size(), 1u);
    ASSERT_EQ(scene.emission_textures.size(), 1u);
    EXPECT_EQ(polygons(scene)[0].texture, 0);
    const TexturedEmission& emission = scene.emission_textures[0];
    EXPECT_EQ(emission.texture->width, 8);
    EXPECT_EQ(emission.texture->height, 4);
    expect_near(emission.texture->texels[8 + 3], {3, 1, 1}, 0);
    expect_near(emission.mean, {3.5f, 1.5f, 1}, 1e-5f);
    expect_near(polygons(scene)[0].radiance, {7, 3, 2}, 1e-5f);
    expect_near(texel_scale(polygons(scene)[0], emission), {2, 2, 2}, 1e-6f);
    const TexturePlacement placement = place_texture(polygons(scene)[0], emission);
    expect_near(placement.corner, {0, 0, 0}, 1e-6f);
    expect_near(placement.side_x, {2, 0, 0}, 1e-6f);
    expect_near(placement.side_y, {0, 1, 0}, 1e-6f);
}

TEST_F(ImageEmission, TwoTrianglesWithOneMapAreOneLight) {
    const Scene scene = light(mesh("0 0 1 0 1 1 0 1"));
    ASSERT_EQ(polygons(scene).size(), 1u);
    EXPECT_EQ(polygons(scene)[0].vertices.size(), 4u);
    expect_near(polygons(scene)[0].radiance, {3.5f, 1.5f, 1}, 1e-5f);
}

TEST_F(ImageEmission, TrianglesWithMapsOfTheirOwnAreApart) {
    const Scene scene = light(mesh("0 0 1 0 1 1 0 0.5"));
    ASSERT_EQ(polygons(scene).size(), 2u);
    EXPECT_EQ(scene.triangle_light[0], 0);
    EXPECT_EQ(scene.triangle_light[1], 1);
    EXPECT_EQ(polygons(scene)[1].texture, 1);
}

/// Texels that interpolation on the light reads, and no others.
TEST_F(ImageEmission, ALightHasTheTexelsThatItShows) {
    const Scene scene = light(mesh("0.25 0.5 0.5 0.5 0.5 1 0.25 1"));
    const TexturedEmission& emission = scene.emission_textures.at(0);
    EXPECT_EQ(emission.texture->width, 4);
    EXPECT_EQ(emission.texture->height, 3);
    expect_near(emission.texture->texels[0], {1, 1, 1}, 0);
    // The ramp is linear but for the last half row of texels.
    EXPECT_NEAR(emission.mean.x, 2.5f, 1e-5f);
    EXPECT_NEAR(emission.coordinates[0].x, 0.25f, 1e-6f);
    const TexturePlacement placement = place_texture(polygons(scene)[0], emission);
    // The texels from 1 to 5 take twice the width of the light.
    expect_near(placement.corner, {-1, -0.5f, 0}, 1e-5f);
    expect_near(placement.side_x, {4, 0, 0}, 1e-5f);
}

TEST_F(ImageEmission, BeyondTheImageItsEdgeGoesOn) {
    const Scene scene = light(mesh("-1 0 1 0 1 1 -1 1"));
    const TexturedEmission& emission = scene.emission_textures.at(0);
    EXPECT_EQ(emission.texture->width, 16);
    expect_near(emission.texture->texels[7], {0, 0, 1}, 0);
    expect_near(emission.texture->texels[9], {1, 0, 1}, 0);
    EXPECT_NEAR(emission.mean.x, 3.5f / 2, 1e-5f);
}

TEST_F(ImageEmission, FarOutsideTheMeanIsEmitted) {
    const Scene scene = light(mesh("-1e5 0 1 0 1 1 -1e5 1"));
    EXPECT_TRUE(scene.emission_textures.empty());
    expect_near(polygons(scene).at(0).radiance, {3.5f, 1.5f, 1}, 1e-5f);
    EXPECT_EQ(warning(scene),
              "scene.pbrt:4: shape \"trianglemesh\": texture coordinates are so far outside of the image "
              "that its mean colour is emitted");
}

TEST_F(ImageEmission, WithoutCoordinatesTheMeanIsEmitted) {
    const Scene scene = light(mesh(""));
    EXPECT_TRUE(scene.emission_textures.empty());
    expect_near(polygons(scene).at(0).radiance, {3.5f, 1.5f, 1}, 1e-5f);
    EXPECT_EQ(warning(scene),
              "scene.pbrt:4: shape \"trianglemesh\": without texture coordinates, the mean colour of the "
              "image is emitted");
}

TEST_F(ImageEmission, CoordinatesWithoutAreaGiveOneColour) {
    const Scene scene = light(mesh("0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5"));
    EXPECT_TRUE(scene.emission_textures.empty());
    expect_near(polygons(scene).at(0).radiance, {3.5f, 1.5f, 1}, 1e-5f);
}

TEST_F(ImageEmission, ThePowerIsThatOfTheWholeShape) {
    const Scene scene = light(mesh("0 0 1 0 1 1 0 0.5"), "\"float power\" 10");
    double sum = 0;
    for (const PolygonLight& polygon : polygons(scene))
        sum += 3.14159265 * area(polygon) *
               (0.2126 * polygon.radiance.x + 0.7152 * polygon.radiance.y + 0.0722 * polygon.radiance.z);
    EXPECT_NEAR(sum, 10, 1e-3);
}

TEST_F(ImageEmission, MirroredShapesKeepTheirImage) {
    const Scene scene = light("Scale -1 1 1\n" + std::string(kQuad));
    const TexturePlacement placement = place_texture(polygons(scene).at(0), scene.emission_textures.at(0));
    expect_near(placement.side_x, {-2, 0, 0}, 1e-6f);
    expect_near(placement.side_y, {0, 1, 0}, 1e-6f);
    EXPECT_EQ(emitting_normal(polygons(scene)[0]).z, 1);
}

/// The rows of the image are along v, from the start of the tube.
TEST_F(ImageEmission, TubesHaveTheMeansOfRows) {
    const Scene scene =
        light("Shape \"line\" \"point3 P\" [0 0 0 1 0 0] \"float radius\" 0.1", "\"float scale\" 2");
    EXPECT_EQ(warning(scene),
              "scene.pbrt:4: shape \"line\": each row of the image is replaced by its mean, because "
              "radiance varies along tubes only");
    const LineLight& tube = scene.lights.of<LineLight>().at(0);
    expect_near(tube.radiance, {7, 3, 2}, 1e-5f);
    EXPECT_EQ(tube.texture, 0);
    const TexturedEmission& emission = scene.emission_textures.at(0);
    ASSERT_EQ(emission.texture->width, 1);
    ASSERT_EQ(emission.texture->height, 4);
    expect_near(emission.texture->texels[0], {3.5f, 0, 1}, 1e-6f);
    expect_near(emission.texture->texels[3], {3.5f, 3, 1}, 1e-6f);
    expect_near(emission.mean, {3.5f, 1.5f, 1}, 1e-5f);
}

TEST_F(ImageEmission, TubesHaveAtMost64Rows) {
    write_ramp("ramp.pfm", 1, 160);
    const Scene scene = light("Shape \"line\" \"point3 P\" [0 0 0 1 0 0] \"float radius\" 0.1");
    EXPECT_EQ(warning(scene), "scene.pbrt:4: shape \"line\": the 160 rows of the image are reduced to 64");
    const std::vector<Float3>& texels = scene.emission_textures.at(0).texture->texels;
    ASSERT_EQ(texels.size(), 64u);
    // Rows 0, 1 and half of row 2, over 2.5.
    expect_near(texels[0], {0, 0.8f, 1}, 1e-5f);
    expect_near(texels[63], {0, 158.2f, 1}, 1e-3f);
}

TEST_F(ImageEmission, TubesOfOneRowAreUniform) {
    write_ramp("ramp.pfm", 1, 1);
    const Scene scene = light("Shape \"line\" \"point3 P\" [0 0 0 1 0 0] \"float radius\" 0.1");
    EXPECT_EQ(scene.lights.of<LineLight>().at(0).texture, -1);
    EXPECT_TRUE(scene.emission_textures.empty());
}

/// Each shape has its own texture after shapes are joined.
TEST_F(ImageEmission, TubesAndPolygonsShareTheListOfTextures) {
    const Scene scene =
        light(std::string(kQuad) + "\nShape \"line\" \"point3 P\" [0 0 3 1 0 3] \"float radius\" 0.1");
    EXPECT_EQ(scene.emission_textures.size(), 2u);
    EXPECT_EQ(polygons(scene).at(0).texture, 0);
    EXPECT_EQ(scene.lights.of<LineLight>().at(0).texture, 1);
}

TEST_F(ImageEmission, ManyPolygonsAreTexturedUpToALimit) {
    // Strips along x in different heights: none is the neighbour of another one.
    std::string shape = "Shape \"trianglemesh\" \"point3 P\" [";
    std::string uv = "] \"point2 uv\" [";
    std::string indices = "] \"integer indices\" [";
    const std::size_t count = 1025;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string z = std::to_string(i);
        shape += "0 0 " + z + " 1 0 " + z + " 0 1 " + z + " ";
        uv += "0 0 1 0 0 1 ";
        indices +=
            std::to_string(3 * i) + " " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) + " ";
    }
    const Scene scene = light(shape + uv + indices + "]");
    EXPECT_EQ(polygons(scene).size(), count);
    EXPECT_EQ(scene.emission_textures.size(), 1024u);
    EXPECT_EQ(polygons(scene).back().texture, -1);
    expect_near(polygons(scene).back().radiance, polygons(scene).front().radiance, 1e-6f);
    EXPECT_EQ(warning(scene),
              "scene.pbrt:4: shape \"trianglemesh\": of 1025 polygons that emit an image, those after the "
              "first 1024 emit the mean of their part of it");
}

/// The left half of the image is black.
TEST_F(ImageEmission, PolygonsThatShowOnlyBlackAreSurfaces) {
    image::Image image = image::make_image(8, 4);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = i / 3 % 8 < 4 ? 0.0f : 1.0f;
    image::write_image(folder_ / "ramp.pfm", image);
    for (const char* const emission : {"", "\"float power\" 10"}) {
        const Scene black = light(mesh("0 0 0.3 0 0.3 1 0 1"), emission);
        EXPECT_TRUE(black.lights.empty());
        EXPECT_TRUE(black.emitters.empty());
        EXPECT_TRUE(black.emission_textures.empty());
        ASSERT_EQ(black.triangles.size(), 2u);
        EXPECT_EQ(black.triangle_light, (std::vector<std::int32_t>{-1, -1}));
        EXPECT_EQ(
            warning(black),
            "scene.pbrt:4: shape \"trianglemesh\": it emits no light because what it shows of the image "
            "'ramp.pfm' is black (below 1e-30)");

        // The second triangle has a map of its own, to the bright half.
        const Scene half =
            light("Shape \"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 2 1 0 0 0 0 2 1 0 0 1 0] "
                  "\"integer indices\" [0 1 2 3 4 5] \"point2 uv\" [0 0 0.3 0 0.3 1 1 0 0.7 1 1 1]",
                  emission);
        ASSERT_EQ(polygons(half).size(), 1u);
        EXPECT_EQ(half.triangle_light, (std::vector<std::int32_t>{-1, 0}));
        EXPECT_EQ(polygons(half)[0].texture, 0);
        EXPECT_EQ(half.emission_textures.size(), 1u);
        EXPECT_NEAR(polygons(half)[0].radiance.x, *emission == '\0' ? 1 : 10 / 3.14159265, 1e-5);
        EXPECT_EQ(warning(half),
                  "scene.pbrt:4: shape \"trianglemesh\": 1 of 2 polygons emit no light because their "
                  "part of the image is black");
    }
}

/// The mean is within the limit, but not the brightest texel, which is twice as large.
TEST_F(ImageEmission, TexelsAreWithinTheLimit) {
    const std::string text =
        "Camera \"perspective\"\nWorldBegin\nAreaLightSource \"diffuse\" \"string filename\" "
        "\"ramp.pfm\" \"float scale\" ";
    const std::string message = "AreaLightSource: radiance must be from 0 to 1e+30, found ";
    EXPECT_NE(error(text + "2e29\n" + kQuad).find(message + "1.4"), std::string::npos);
    // The part that a light shows counts.
    EXPECT_EQ(load(text + "2e29\n" + mesh("0 0 0.4 0 0.4 1 0 1")).warnings.size(), 0u);
    const std::string tube = "\nShape \"line\" \"point3 P\" [0 0 0 1 0 0] \"float radius\" 0.1";
    write_ramp("ramp.pfm", 2, 8);
    EXPECT_NE(error(text + "2e29" + tube).find(message + "1.4"), std::string::npos);
}

TEST_F(ImageEmission, HostileImages) {
    EXPECT_EQ(error("Camera \"perspective\"\nWorldBegin\nAreaLightSource \"diffuse\" \"string filename\" "
                    "\"none.png\"\n" +
                    std::string(kQuad)),
              "scene.pbrt:3: texture file 'none.png': no such file");
    write("broken.png", "\x89PNG no");
    EXPECT_TRUE(error("Camera \"perspective\"\nWorldBegin\nAreaLightSource \"diffuse\" \"string filename\" "
                      "\"broken.png\"\n" +
                      std::string(kQuad))
                    .starts_with("scene.pbrt:3: texture file 'broken.png': "));
    EXPECT_TRUE(error("Camera \"perspective\"\nWorldBegin\nAreaLightSource \"diffuse\" \"string filename\" "
                      "\"ramp.pfm\" \"float scale\" 9e29\n" +
                      std::string(kQuad))
                    .starts_with("scene.pbrt:4: AreaLightSource: radiance must be from 0 to 1e+30, found "));
    // Negative and infinite texels are black, which one warning says.
    image::Image image = image::make_image(2, 1);
    image.pixels = {-1, 2, std::numeric_limits<float>::infinity(), 1, 2, 3};
    image::write_image(folder_ / "ramp.pfm", image);
    const Scene scene = light(kQuad);
    expect_near(polygons(scene).at(0).radiance, {0.5f, 2, 1.5f}, 1e-6f);
    EXPECT_EQ(warning(scene),
              "scene.pbrt:3: texture file 'ramp.pfm': 2 negative or non-finite numbers are replaced by 0");
}

TEST_F(ImageEmission, ReportsTakeTheMeanOverAllPolygons) {
    const std::vector<PolygonLight> two = {
        {.texture = 0, .vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .radiance = {4, 0, 1}},
        {.texture = 0, .vertices = {{1, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}}, .radiance = {0, 8, 1}}};
    EXPECT_EQ(LightKind<PolygonLight>::describe(two, 7),
              "2 polygons, 8 vertices, 4 m^2, textured, mean radiance 1 6 1 W/(sr m^2), power 12.5664 "
              "75.3982 12.5664 W");
}

} // namespace
} // namespace nusselt::scene
