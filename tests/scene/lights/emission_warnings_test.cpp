// Lights that a profile, an image, a map or a grid leaves without emission: they are no lights, and a warning says why. Numbers
// whose reciprocals overflow count as black.

#include "scene_fixture.h"

#include "image/io.h"
#include "scene/model/limits.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nusselt::scene {
namespace {

constexpr const char* kQuad =
    "Shape \"quad\" \"point o\" [0 0 0] \"vector u\" [2 0 0] \"vector v\" [0 1 0]\n";
constexpr const char* kLine = "Shape \"line\" \"point3 P\" [0 0 0 1 0 0] \"float radius\" 0.1\n";
constexpr const char* kMesh = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";
constexpr const char* kSphere = "Shape \"sphere\"\n";

class DarkLights : public SceneTest {
protected:
    DarkLights() {
        write_profile("dark.ies", "1e-40 1e-40 1e-40");
        write_profile("zero.ies", "0 0 0");
        write_profile("sideways.ies", "0 0 9");
        write_image("dark.pfm", {1e-40f, 1e-41f, 1e-42f});
        write_image("zero.pfm", {0, 0, 0});
        write_image("red.pfm", {1, 1e-40f, 1e-40f});
    }
    /// Intensities at 0, 45 and 90 degrees from the axis.
    void write_profile(const std::string& name, const std::string& candelas) const {
        write(name,
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 1 1 0\n1 1 10\n0 45 90\n0\n" + candelas + "\n");
    }
    /// 4 x 2 texels of a colour.
    void write_image(const std::string& name, const Float3& colour) const {
        image::Image image = image::make_image(4, 2);
        for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
            image.pixels[i] = colour.x;
            image.pixels[i + 1] = colour.y;
            image.pixels[i + 2] = colour.z;
        }
        image::write_image(folder_ / name, image);
    }
    Scene world(const std::string& text) const { return load("Camera \"perspective\"\nWorldBegin\n" + text); }
    /// The only warning of a light on line 5, after the name of the light. The scene must have no lights.
    std::string reason(const std::string& emission, const std::string& shape) const {
        const Scene scene = world(std::string(kTriangle) + emission + "\n" + shape);
        EXPECT_TRUE(scene.lights.empty()) << emission << shape;
        EXPECT_TRUE(scene.emitters.empty()) << emission << shape;
        for (const std::int32_t light : scene.triangle_light) EXPECT_EQ(light, -1) << emission << shape;
        const std::string text = warning(scene);
        EXPECT_EQ(text.rfind("scene.pbrt:5: ", 0), 0u) << text;
        return text.substr(std::min(text.find(": it emits") + 2, text.size()));
    }
};

std::string area(const std::string& parameters) { return "AreaLightSource \"diffuse\" " + parameters; }

TEST_F(DarkLights, Profiles) {
    for (const std::string name : {"dark.ies", "zero.ies"}) {
        const std::string expected =
            "it emits no light because its profile '" + name + "' is black (below 1e-30 cd)";
        for (const std::string power : {"", " \"float power\" 10"}) {
            const std::string ies = "\"string ies\" \"" + name + "\"" + power;
            for (const char* const shape : {kQuad, kLine, kMesh})
                EXPECT_EQ(reason(area(ies), shape), expected);
            EXPECT_EQ(reason("", "LightSource \"point\" " + ies), expected);
            EXPECT_EQ(reason("", "LightSource \"spot\" " + ies), expected);
        }
    }
    // What a shape with too many normals would emit alike in all directions.
    const Scene sphere = world(area("\"string ies\" \"dark.ies\"") + "\n" + kSphere);
    EXPECT_TRUE(sphere.lights.empty());
    EXPECT_NE(sphere.warnings.back().find("'dark.ies' is black"), std::string::npos)
        << sphere.warnings.back();
}

TEST_F(DarkLights, ProfilesBehindAGrid) {
    const std::string expected = "it emits no light because its profile 'sideways.ies' emits nothing in the "
                                 "directions that its spread or honeycomb lets pass";
    EXPECT_EQ(reason(area("\"string ies\" \"sideways.ies\" \"float spread\" 60"), kQuad), expected);
    EXPECT_EQ(reason(area("\"string ies\" \"sideways.ies\" \"float honeycomb\" 40"), kQuad), expected);
    EXPECT_EQ(world(area("\"string ies\" \"sideways.ies\" \"float spread\" 150") + "\n" + kQuad)
                  .lights.of<PolygonLight>()
                  .size(),
              1u);
}

TEST_F(DarkLights, ProfilesOfHugeLights) {
    write_profile("weak.ies", "0.1 0.1 0.1");
    const std::string huge =
        "Shape \"quad\" \"point o\" [0 0 0] \"vector u\" [1e15 0 0] \"vector v\" [0 1e15 0]\n";
    EXPECT_EQ(
        reason(area("\"string ies\" \"weak.ies\""), huge),
        "it emits no light because its profile 'weak.ies' is too weak for its area (below 1e-30 cd/m^2)");
    EXPECT_EQ(world(area("\"string ies\" \"weak.ies\"") + "\n" + kQuad).lights.of<PolygonLight>().size(), 1u);
}

TEST_F(DarkLights, Images) {
    for (const std::string name : {"dark.pfm", "zero.pfm"}) {
        const std::string expected =
            "it emits no light because what it shows of the image '" + name + "' is black (below 1e-30)";
        for (const std::string power : {"", " \"float power\" 10"}) {
            const std::string image = "\"string filename\" \"" + name + "\"" + power;
            for (const char* const shape : {kQuad, kLine, kMesh})
                EXPECT_EQ(reason(area(image), shape), expected);
            EXPECT_EQ(reason("", "LightSource \"projection\" " + image), expected);
        }
        EXPECT_EQ(reason("", "LightSource \"infinite\" \"string filename\" \"" + name + "\""), expected);
        EXPECT_EQ(reason("", "LightSource \"infinite\" \"float illuminance\" 5 \"string filename\" \"" +
                                 name + "\""),
                  expected);
    }
    const std::string scaled =
        "it emits no light because what it shows of the image 'red.pfm' is black (below 1e-30)";
    const std::string image = "\"string filename\" \"red.pfm\" \"float scale\" 1e-35";
    EXPECT_EQ(reason(area(image), kQuad), scaled);
    EXPECT_EQ(reason(area(image), kLine), scaled);
    EXPECT_EQ(reason("", "LightSource \"infinite\" " + image), scaled);
}

TEST_F(DarkLights, EachIsNamed) {
    const std::string dark = area("\"string filename\" \"zero.pfm\"") + "\n" + kQuad;
    const Scene scene = world(dark + dark);
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_EQ(without_folder(scene.warnings[1]).rfind("scene.pbrt:6: shape \"quad\": it emits no light", 0),
              0u);
}

/// Renderers divide by means and by radiance.
TEST_F(DarkLights, DarkChannelsOfBrightImagesAreBlack) {
    const std::string image = "\"string filename\" \"red.pfm\"";
    const Scene scene =
        world("LightSource \"infinite\" " + image + "\n" + area(image) + "\n" + kQuad + kLine);
    EXPECT_TRUE(scene.warnings.empty());
    const auto expect_red = [](const Float3& radiance, const Float3& mean) {
        EXPECT_NEAR(radiance.x, 1, 1e-5f);
        EXPECT_EQ(radiance.y, 0);
        EXPECT_EQ(radiance.z, 0);
        EXPECT_EQ(mean.y, 0);
        const Float3 inverse = per_channel_ratio({1, 1, 1}, radiance);
        const Float3 scale = per_channel_ratio(radiance, mean);
        for (const float number : {inverse.x, inverse.y, inverse.z, scale.x, scale.y, scale.z})
            EXPECT_TRUE(std::isfinite(number));
    };
    expect_red(scene.lights.of<PolygonLight>().at(0).radiance, scene.emission_textures.at(0).mean);
    expect_red(scene.lights.of<EnvironmentLight>().at(0).radiance, scene.environment_maps.at(0)->mean);
    expect_near(scene.lights.of<LineLight>().at(0).radiance, {1, 0, 0}, 1e-5f);
}

} // namespace
} // namespace nusselt::scene
