// Image files and texture directives.

#include "scene_fixture.h"

#include <array>
#include <cmath>
#include <stb/stb_image_write.h>

namespace nusselt::scene {
namespace {

/// Uncompressed 24 bit TGA, rows given from the top of the picture. Files store them from the bottom.
std::string tga(int width, int height, const std::vector<std::array<int, 3>>& rgb_from_top) {
    std::string bytes(18, '\0');
    bytes[2] = 2;
    bytes[12] = static_cast<char>(width);
    bytes[14] = static_cast<char>(height);
    bytes[16] = 24;
    for (int y = height - 1; y >= 0; --y) {
        for (int x = 0; x < width; ++x) {
            const auto& pixel = rgb_from_top[static_cast<std::size_t>(y * width + x)];
            for (const std::size_t channel : {2, 1, 0}) bytes += static_cast<char>(pixel[channel]);
        }
    }
    return bytes;
}

double linear_from_srgb(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

class Textures : public SceneTest {
protected:
    Textures() {
        // Red over green, 2 wide: the second column is half as bright (in sRGB).
        write("a.tga", tga(2, 2, {{{255, 0, 0}}, {{128, 0, 0}}, {{0, 255, 0}}, {{0, 128, 0}}}));
    }
    Scene textured(const std::string& parameters, const std::string& before = "") const {
        return load("Camera \"perspective\" WorldBegin\n" + before + "Texture \"t\" \"spectrum\" " +
                    parameters + "\nMaterial \"matte\" \"texture Kd\" \"t\"\n" + std::string(kTriangle));
    }
    /// The diffuse colour that a texture reduces to, which has no image.
    Float3 constant(const std::string& parameters, const std::string& before = "") const {
        const Scene scene = textured(parameters, before);
        EXPECT_TRUE(scene.textures.empty());
        EXPECT_EQ(scene.materials.at(0).diffuse_texture.texture, -1);
        return scene.materials[0].diffuse;
    }
};

TEST_F(Textures, RowZeroIsTheBottomAndTexelsAreLinear) {
    const Scene scene = textured("\"imagemap\" \"string filename\" \"a.tga\" \"bool trilinear\" \"true\"");
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials[0].diffuse_texture.texture, 0);
    const Texture& texture = scene.textures[0];
    EXPECT_EQ(texture.width, 2);
    EXPECT_EQ(texture.height, 2);
    EXPECT_EQ(texture.name, "a.tga");
    const float half = static_cast<float>(linear_from_srgb(128 / 255.0));
    const std::vector<float> expected = {0, 1, 0, 0, half, 0, 1, 0, 0, half, 0, 0};
    ASSERT_EQ(texture.texels.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(texture.texels[i], expected[i], 1e-6f) << i;
}

TEST_F(Textures, OtherFormats) {
    std::vector<unsigned char> pixels;
    for (int i = 0; i < 16 * 16; ++i) pixels.insert(pixels.end(), {200, 100, 50});
    std::vector<float> radiance(16 * 16 * 3, 4.0f);
    ASSERT_NE(stbi_write_png((folder_ / "b.png").c_str(), 16, 16, 3, pixels.data(), 16 * 3), 0);
    ASSERT_NE(stbi_write_jpg((folder_ / "b.jpg").c_str(), 16, 16, 3, pixels.data(), 95), 0);
    ASSERT_NE(stbi_write_hdr((folder_ / "b.hdr").c_str(), 16, 16, 3, radiance.data()), 0);
    for (const std::string name : {"b.png", "b.jpg"}) {
        const Scene scene = textured("\"imagemap\" \"string filename\" \"" + name + "\"");
        ASSERT_EQ(scene.textures.at(0).texels.size(), 768u);
        EXPECT_NEAR(scene.textures[0].texels[300], linear_from_srgb(200 / 255.0), 0.02);
        EXPECT_NEAR(scene.textures[0].texels[301], linear_from_srgb(100 / 255.0), 0.02);
        EXPECT_NEAR(scene.textures[0].texels[302], linear_from_srgb(50 / 255.0), 0.02);
    }
    const Scene scene = textured("\"imagemap\" \"string filename\" \"b.hdr\"");
    EXPECT_EQ(scene.textures.at(0).texels[100], 4);
}

TEST_F(Textures, EncodingScaleAndInversion) {
    const std::string file = "\"imagemap\" \"string filename\" \"a.tga\" ";
    const float half = 128 / 255.0f;
    EXPECT_NEAR(textured(file + "\"string encoding\" \"linear\"").textures.at(0).texels[9], half, 1e-6f);
    EXPECT_NEAR(textured(file + "\"bool gamma\" false").textures.at(0).texels[9], half, 1e-6f);
    expect_near(textured(file + "\"float scale\" 0.25").materials.at(0).diffuse, {0.25f, 0.25f, 0.25f}, 0);
    const Scene inverted =
        textured(file + "\"bool invert\" true \"float scale\" 0.5 \"string encoding\" \"linear\"");
    EXPECT_NEAR(inverted.textures.at(0).texels[9], 1 - 0.5f * half, 1e-6f);
    expect_near(inverted.materials.at(0).diffuse, {1, 1, 1}, 0);
    const Scene clamped = textured(file + "\"bool invert\" true \"float scale\" 3");
    EXPECT_EQ(clamped.textures.at(0).texels[6], 0);
}

TEST_F(Textures, EachFileIsDecodedOnceAndOnlyIfUsed) {
    write("broken.tga", "no image");
    const Scene scene = load(R"(Camera "perspective" WorldBegin
        Texture "unused" "spectrum" "imagemap" "string filename" "broken.tga"
        Texture "a" "spectrum" "imagemap" "string filename" "a.tga"
        Texture "b" "spectrum" "imagemap" "string filename" "./a.tga" "float scale" 0.5
        MakeNamedMaterial "unused" "string type" "matte" "texture Kd" "unused"
        MakeNamedMaterial "a" "string type" "matte" "texture Kd" "a"
        MakeNamedMaterial "b" "string type" "matte" "texture Kd" "b"
        NamedMaterial "b" )" +
                             std::string(kTriangle) + "NamedMaterial \"a\" " + std::string(kTriangle));
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.textures.size(), 1u);
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].diffuse_texture.texture, 0);
    EXPECT_EQ(scene.materials[1].diffuse_texture.texture, 0);
    EXPECT_EQ(scene.materials[0].diffuse.x, 0.5f);
}

TEST_F(Textures, ConstantsAndProducts) {
    const std::string colours = "Texture \"c\" \"spectrum\" \"constant\" \"rgb value\" [0.5 0.25 1]\n"
                                "Texture \"d\" \"float\" \"constant\" \"float value\" 0.5\n"
                                "Texture \"i\" \"spectrum\" \"imagemap\" \"string filename\" \"a.tga\"\n";
    expect_near(constant("\"constant\" \"rgb value\" [0.1 0.2 0.3]"), {0.1f, 0.2f, 0.3f}, 0);
    expect_near(constant("\"scale\" \"texture tex1\" \"c\" \"texture tex2\" \"d\"", colours),
                {0.25f, 0.125f, 0.5f}, 0);
    expect_near(constant("\"scale\" \"texture tex\" \"c\" \"float scale\" 0.5", colours),
                {0.25f, 0.125f, 0.5f}, 0);
    expect_near(
        constant("\"mix\" \"texture tex1\" \"c\" \"rgb tex2\" [1 1 0] \"float amount\" 0.25", colours),
        {0.625f, 0.4375f, 0.75f}, 1e-6f);
    const Scene product = textured("\"scale\" \"texture tex\" \"i\" \"texture scale\" \"c\"", colours);
    EXPECT_TRUE(product.warnings.empty());
    EXPECT_EQ(product.materials.at(0).diffuse_texture.texture, 0);
    expect_near(product.materials[0].diffuse, {0.5f, 0.25f, 1}, 0);
}

TEST_F(Textures, WhatIsReplaced) {
    const auto expect_warning = [&](const std::string& parameters, const std::string& message) {
        EXPECT_EQ(warning(textured(parameters)), message);
    };
    expect_near(constant("\"marble\" \"float scale\" 3"), {0.80f, 0.79f, 0.83f}, 0);
    expect_near(constant("\"dots\" \"rgb inside\" [1 1 1] \"rgb outside\" [0 0.5 1]"), {0.19f, 0.595f, 1},
                1e-6f);
    expect_near(
        constant(
            "\"bilerp\" \"rgb v00\" [1 0 0] \"rgb v11\" [0 1 0] \"rgb v01\" [0 0 0] \"rgb v10\" [0 0 1]"),
        {0.25f, 0.25f, 0.25f}, 1e-6f);
    expect_near(constant("\"directionmix\" \"rgb tex1\" [1 1 1] \"rgb tex2\" [0 0.5 1]"), {0.5f, 0.75f, 1},
                1e-6f);
    expect_near(constant("\"checkerboard\" \"integer dimension\" 3 \"rgb tex2\" [0 0.5 1]"), {0.5f, 0.75f, 1},
                1e-6f);
    expect_warning("\"fbm\" \"integer octaves\" 3",
                   "scene.pbrt:2: Texture \"fbm\": not supported; its mean replaces it");
    expect_warning("\"dots\"", "scene.pbrt:2: Texture \"dots\": not supported; its mean replaces it");
    expect_warning(
        "\"imagemap\" \"string filename\" \"a.tga\" \"string mapping\" \"spherical\"",
        "scene.pbrt:2: texture \"t\": mapping \"spherical\" is not supported; the texture coordinates of "
        "the mesh replace it");
    expect_warning(
        "\"imagemap\" \"string filename\" \"a.tga\" \"string wrap\" \"octahedralsphere\"",
        "scene.pbrt:2: texture \"t\": wrap \"octahedralsphere\" is not supported; \"repeat\" replaces it");
}

TEST_F(Textures, Errors) {
    write("broken.png", "no image");
    const auto material = [](const std::string& texture) {
        return texture + "\nMaterial \"matte\" \"texture Kd\" \"t\"\n" + std::string(kTriangle);
    };
    EXPECT_EQ(error(material("Texture \"t\" \"spectrum\" \"imagemap\"\n\"string filename\" \"none.png\"")),
              "scene.pbrt:2: texture file 'none.png': no such file");
    EXPECT_EQ(
        error(material("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"broken.png\"")),
        "scene.pbrt:1: texture file 'broken.png': the file does not begin like PNG, JPG or BMP, "
        "and as TGA it is damaged or not supported: it has only 8 bytes, but its header would have 18; check "
        "its name or convert it to PNG");
    EXPECT_EQ(error("\nTexture \"t\" \"spectrum\" \"imagemap\""),
              "scene.pbrt:2: texture \"t\": parameter \"string filename\" is missing");
    EXPECT_EQ(error("Texture \"t\" \"vector\" \"constant\""),
              "scene.pbrt:1: texture \"t\": expected type \"float\" or \"spectrum\", found \"vector\"");
    EXPECT_EQ(error(material("")), "scene.pbrt:2: texture \"t\" is not defined");
}

} // namespace
} // namespace nusselt::scene
