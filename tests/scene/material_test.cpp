// Reduction of materials, with the numbers of docs/materials.md.

#include "scene/build/textures/reflectance.h"
#include "scene_fixture.h"

#include <cmath>

namespace nusselt::scene {
namespace {

class Materials : public SceneTest {
protected:
    Scene with(const std::string& material) const {
        return load("Camera \"perspective\"\nWorldBegin\n" + material + "\n" + std::string(kTriangle));
    }
    Material silently(const std::string& material) const {
        const Scene scene = with(material);
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
        return scene.materials.at(0);
    }
    Material warned(const std::string& material, const std::string& message) const {
        const Scene scene = with(material);
        EXPECT_EQ(warning(scene), "scene.pbrt:3: material " + message);
        return scene.materials.at(0);
    }
};

TEST_F(Materials, Lambertian) {
    for (const std::string text :
         {"Material \"matte\" \"rgb Kd\" [0.1 0.2 0.3]", "Material \"matte\" \"color Kd\" [0.1 0.2 0.3]",
          "Material \"diffuse\" \"rgb reflectance\" [0.1 0.2 0.3]"}) {
        const Material material = silently(text);
        EXPECT_EQ(material.model, BrdfModel::lambert);
        expect_near(material.diffuse, {0.1f, 0.2f, 0.3f}, 0);
        EXPECT_EQ(material.diffuse_texture.texture, -1);
    }
    for (const std::string text : {"", "Material \"matte\"", "Material \"diffuse\""})
        expect_near(silently(text).diffuse, {0.5f, 0.5f, 0.5f}, 0);
    warned("Material \"matte\" \"float sigma\" 20", "\"matte\": sigma is ignored");
}

TEST_F(Materials, RoughnessOfBothVersions) {
    // v3: 1.62142 + 0.819955 x + 0.1734 x^2 + 0.0171201 x^3 + 0.000640711 x^4 with x = ln 0.1.
    EXPECT_NEAR(alpha_from_roughness_v3(0.1), 0.4617, 1e-4);
    EXPECT_NEAR(alpha_from_roughness_v3(1), 1.62142, 1e-12);
    EXPECT_EQ(alpha_from_roughness_v3(0), alpha_from_roughness_v3(1e-3));
    EXPECT_EQ(alpha_from_roughness_v4(0.25), 0.5);
    EXPECT_FLOAT_EQ(roughness_from_alpha(0.25), 0.5f);
    EXPECT_FLOAT_EQ(roughness_from_alpha(7), 1);
    EXPECT_FLOAT_EQ(roughness_from_alpha(0), std::sqrt(1e-3f));
}

TEST_F(Materials, Fresnel) {
    EXPECT_NEAR(dielectric_f0(1.5), 0.04, 1e-15);
    EXPECT_NEAR(conductor_f0(1.657460, 9.223869), 0.928047, 1e-6);
    EXPECT_EQ(conductor_f0(1, 0), 0);
}

TEST_F(Materials, Substrate) {
    const Material material =
        silently("Material \"substrate\" \"rgb Kd\" [0.5 0.6 0.7] \"rgb Ks\" [0.04 0.1 0.2] "
                 "\"float uroughness\" 0.16 \"float vroughness\" 0.16 \"bool remaproughness\" false");
    EXPECT_EQ(material.model, BrdfModel::frostbite);
    expect_near(material.diffuse, {0.48f, 0.54f, 0.56f}, 1e-6f);
    expect_near(material.f0, {0.04f, 0.1f, 0.2f}, 0);
    EXPECT_FLOAT_EQ(material.roughness, 0.4f);
    EXPECT_NEAR(silently("Material \"substrate\"").roughness, std::sqrt(0.4617), 1e-4);
}

TEST_F(Materials, AnisotropyIsAveraged) {
    const Material material =
        warned("Material \"substrate\" \"float uroughness\" 0.01 \"float vroughness\" 0.04 "
               "\"bool remaproughness\" false",
               "\"substrate\": anisotropic roughness is replaced by its geometric mean");
    EXPECT_FLOAT_EQ(material.roughness, std::sqrt(0.02f));
}

TEST_F(Materials, CoatedDiffuse) {
    const Material rough =
        silently("Material \"coateddiffuse\" \"rgb reflectance\" [0.2 0.4 0.6] \"float roughness\" 1 "
                 "\"float eta\" 1.5 \"float thickness\" 0.1");
    EXPECT_EQ(rough.model, BrdfModel::frostbite);
    expect_near(rough.diffuse, {0.2f, 0.4f, 0.6f}, 0);
    expect_near(rough.f0, {0.04f, 0.04f, 0.04f}, 1e-7f);
    EXPECT_EQ(rough.roughness, 1);
    EXPECT_FLOAT_EQ(silently("Material \"coateddiffuse\" \"float roughness\" 0.0625").roughness, 0.5f);
    EXPECT_FLOAT_EQ(silently("Material \"coateddiffuse\"").roughness, 0.1f); // perfectly smooth in pbrt
}

TEST_F(Materials, UberAndPlastic) {
    const Material uber =
        silently("Material \"uber\" \"rgb Kd\" [0.1 0.2 0.3] \"rgb Ks\" [1 0.5 0] \"float eta\" 2 "
                 "\"float roughness\" 0.25 \"bool remaproughness\" false");
    EXPECT_EQ(uber.model, BrdfModel::frostbite);
    expect_near(uber.diffuse, {0.1f, 0.2f, 0.3f}, 0);
    expect_near(uber.f0, {1 / 9.0f, 0.5f / 9, 0}, 1e-6f);
    EXPECT_FLOAT_EQ(uber.roughness, 0.5f);
    // Without reflection there is nothing for Schlick's formula to raise at grazing angles.
    EXPECT_EQ(silently("Material \"uber\" \"rgb Ks\" [0 0 0]").model, BrdfModel::lambert);
    const Material plastic = silently("Material \"plastic\"");
    expect_near(plastic.f0, {0.01f, 0.01f, 0.01f}, 1e-7f);
    expect_near(plastic.diffuse, {0.25f, 0.25f, 0.25f}, 0);
    warned("Material \"uber\" \"rgb Kr\" [1 1 1]",
           "\"uber\": mirror reflection and transmission (Kr, Kt) are ignored");
    EXPECT_FLOAT_EQ(silently("Material \"uber\" \"rgb opacity\" [0.25 0.25 0.25]").alpha, 0.25f);
    EXPECT_FLOAT_EQ(silently("Material \"uber\" \"rgb opacity\" [1 0.5 0]").alpha, 0.5f);
}

TEST_F(Materials, PhongInBothSyntaxes) {
    for (const std::string text :
         {"Material \"phong\" \"rgb Kd\" [0.1 0.2 0.3] \"rgb Ks\" [0.4 0.5 0.6] \"float exponent\" 40",
          "Material \"phong\" \"color Kd\" [0.1 0.2 0.3] \"color Ks\" [0.4 0.5 0.6] \"float exponent\" 40",
          "MakeNamedMaterial \"shiny\" \"string type\" \"phong\" \"rgb Kd\" [0.1 0.2 0.3] "
          "\"rgb Ks\" [0.4 0.5 0.6] \"float exponent\" 40 NamedMaterial \"shiny\""}) {
        const Material material = silently(text);
        EXPECT_EQ(material.model, BrdfModel::phong);
        expect_near(material.diffuse, {0.1f, 0.2f, 0.3f}, 0);
        expect_near(material.f0, {0.4f, 0.5f, 0.6f}, 0);
        EXPECT_EQ(material.exponent, 40);
        EXPECT_FLOAT_EQ(material.roughness, 1 / 3.0f); // 81^(-1/4)
    }
    const Material plain = silently("Material \"phong\"");
    expect_near(plain.diffuse, {0.25f, 0.25f, 0.25f}, 0);
    expect_near(plain.f0, {0.25f, 0.25f, 0.25f}, 0);
    EXPECT_EQ(plain.exponent, 100);
    EXPECT_EQ(silently("Material \"phong\" \"float exponent\" 0").exponent, 0);
    const std::string clamped = "\"phong\": exponents other than 0 and 1 to 1e6 are clamped";
    EXPECT_EQ(warned("Material \"phong\" \"float exponent\" 0.5", clamped).exponent, 1);
    EXPECT_EQ(warned("Material \"phong\" \"float exponent\" 1e9", clamped).exponent, 1e6f);
    EXPECT_THROW(with("Material \"phong\" \"float exponent\" -1"), std::runtime_error);
}

TEST_F(Materials, MixturesWithPhong) {
    const std::string shiny = "MakeNamedMaterial \"shiny\" \"string type\" \"phong\" \"rgb Kd\" [0 0 0] "
                              "\"rgb Ks\" [1 1 1] \"float exponent\" 40\n";
    const auto mixed_with = [&](const std::string& other) {
        return with(shiny + "MakeNamedMaterial \"other\" " + other +
                    "\nMaterial \"mix\" \"string materials\" [\"shiny\" \"other\"] \"float amount\" 0.25")
            .materials.at(0);
    };
    const Material with_matte = mixed_with("\"string type\" \"diffuse\" \"rgb reflectance\" [0.8 0.8 0.8]");
    EXPECT_EQ(with_matte.model, BrdfModel::phong);
    expect_near(with_matte.diffuse, {0.2f, 0.2f, 0.2f}, 1e-6f);
    expect_near(with_matte.f0, {0.75f, 0.75f, 0.75f}, 1e-6f);
    EXPECT_EQ(with_matte.exponent, 40);
    const std::string wide = "\"string type\" \"phong\" \"rgb Ks\" [1 1 1] \"float exponent\" 0";
    EXPECT_EQ(mixed_with(wide).exponent, 30);
    EXPECT_EQ(
        with("MakeNamedMaterial \"a\" " + wide +
             "\nMakeNamedMaterial \"b\" \"string type\" \"phong\" \"rgb Ks\" [1 1 1] \"float exponent\" 2"
             "\nMaterial \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" 0.25")
            .materials.at(0)
            .exponent,
        1)
        << "not a half, where line samples are not exact";
    const Material with_phong =
        mixed_with("\"string type\" \"phong\" \"rgb Ks\" [1 1 1] \"float exponent\" 80");
    EXPECT_EQ(with_phong.model, BrdfModel::phong);
    EXPECT_FLOAT_EQ(with_phong.exponent, 50);
    const Material with_metal = mixed_with("\"string type\" \"conductor\" \"float roughness\" 1 "
                                           "\"rgb reflectance\" [1 1 1]");
    EXPECT_EQ(with_metal.model, BrdfModel::frostbite);
    EXPECT_FLOAT_EQ(with_metal.roughness, 0.75f / 3 + 0.25f);
}

TEST_F(Materials, InvisibleSurfacesAreLeftOut) {
    const Scene uber = with("Material \"uber\" \"rgb opacity\" [0 0 0]");
    EXPECT_TRUE(uber.triangles.empty());
    EXPECT_TRUE(uber.materials.empty());
    ASSERT_EQ(uber.warnings.size(), 2u);
    EXPECT_EQ(without_folder(uber.warnings[0]),
              "scene.pbrt:3: material \"uber\": surfaces with opacity 0 are invisible and skipped");
    for (const std::string type : {"interface", "none", ""})
        EXPECT_TRUE(with("Material \"" + type + "\"").triangles.empty()) << type;
}

TEST_F(Materials, Metals) {
    const std::string constants =
        " \"rgb eta\" [1.657460 0.880369 0.521229] \"rgb k\" [9.223869 6.269523 4.837001] ";
    const Material metal =
        silently("Material \"metal\" \"float roughness\" 0.09 \"bool remaproughness\" false" + constants);
    EXPECT_EQ(metal.model, BrdfModel::frostbite);
    expect_near(metal.diffuse, {0, 0, 0}, 0);
    expect_near(metal.f0, {0.928047f, 0.917805f, 0.918909f}, 1e-5f);
    EXPECT_FLOAT_EQ(metal.roughness, 0.3f);
    expect_near(silently("Material \"conductor\"" + constants).f0, metal.f0, 0);
    // Published values of integrated reflectances, see NamedSpectra.MetalsReflectAsPublished.
    expect_near(
        silently("Material \"conductor\" \"spectrum eta\" \"metal-Al-eta\" \"spectrum k\" \"metal-Al-k\"").f0,
        {0.913f, 0.922f, 0.924f}, 0.045f);
    expect_near(silently("Material \"conductor\" \"rgb reflectance\" [0.1 0.2 0.3]").f0, {0.1f, 0.2f, 0.3f},
                0);
    const Material copper = silently("Material \"metal\""); // the default
    expect_near(copper.f0, {0.955f, 0.638f, 0.538f}, 0.045f);
    EXPECT_NEAR(copper.roughness, std::sqrt(alpha_from_roughness_v3(0.01)), 1e-6);
    const std::string joined = "\"coatedconductor\": the coating and the metal are combined into one lobe";
    const Material coated = warned("Material \"coatedconductor\" \"float conductor.roughness\" 0.0625 "
                                   "\"rgb conductor.eta\" [3 1.5 1.5] \"rgb conductor.k\" [0 0 1.5]",
                                   joined);
    EXPECT_FLOAT_EQ(coated.roughness, 0.5f);
    // Below the coat the metal has the indices 2, 1 and 1 + i: it reflects 1/9, nothing and 1/5.
    expect_near(coated.f0, {0.04f + 0.1024f / (1 - 0.04f / 9), 0.04f, 0.04f + 0.18432f / (1 - 0.008f)},
                1e-6f);
    // The rougher interface decides.
    EXPECT_FLOAT_EQ(warned("Material \"coatedconductor\" \"float interface.roughness\" 1", joined).roughness,
                    1);
    expect_near(warned("Material \"coatedconductor\" \"rgb reflectance\" [0 0.5 1]", joined).f0,
                {0.04f, 0.52f, 1}, 1e-6f);
}

TEST_F(Materials, MirrorsAndGlass) {
    const Material mirror = warned("Material \"mirror\"",
                                   "\"mirror\": mirrors are polished metals, which reflect only the lights");
    expect_near(mirror.f0, {0.9f, 0.9f, 0.9f}, 0);
    expect_near(mirror.diffuse, {0, 0, 0}, 0);
    EXPECT_FLOAT_EQ(mirror.roughness, 0.1f);
    const std::string opaque = ": transmission is ignored; the surface is opaque and only reflects";
    const Material glass = warned("Material \"glass\" \"float eta\" 2", "\"glass\"" + opaque);
    expect_near(glass.f0, {1 / 9.0f, 1 / 9.0f, 1 / 9.0f}, 1e-6f);
    EXPECT_FLOAT_EQ(glass.roughness, 0.1f);
    expect_near(warned("Material \"dielectric\"", "\"dielectric\"" + opaque).f0, {0.04f, 0.04f, 0.04f},
                1e-6f);
    warned("Material \"thindielectric\"", "\"thindielectric\"" + opaque);
}

TEST_F(Materials, Disney) {
    const Material material = silently(
        "Material \"disney\" \"rgb color\" [1 0.5 0] \"float metallic\" 0.25 \"float roughness\" 0.4");
    expect_near(material.diffuse, {0.75f, 0.375f, 0}, 1e-6f);
    expect_near(material.f0, {0.28f, 0.155f, 0.03f}, 1e-6f);
    EXPECT_FLOAT_EQ(material.roughness, 0.4f);
    warned("Material \"disney\" \"float sheen\" 0.5", "\"disney\": sheen is ignored");
    // The tint is the colour over its luminance, 0.715160 for green.
    expect_near(silently("Material \"disney\" \"rgb color\" [0 1 0] \"float speculartint\" 0.5").f0,
                {0.02f, 0.02f + 0.02f / 0.715160f, 0.02f}, 1e-6f);
}

TEST_F(Materials, Transmission) {
    const std::string reflection = ": transmission is ignored; the surface only reflects";
    const Material translucent =
        warned("Material \"translucent\" \"rgb Kd\" [0 0 1] \"rgb reflect\" [1 1 0.25]",
               "\"translucent\"" + reflection);
    expect_near(translucent.diffuse, {0, 0, 0.25f}, 0);
    expect_near(translucent.f0, {0.01f, 0.01f, 0.0025f}, 1e-7f);
    const Material leaf =
        warned("Material \"diffusetransmission\" \"rgb reflectance\" [0 1 0] \"float scale\" 0.5",
               "\"diffusetransmission\"" + reflection);
    EXPECT_EQ(leaf.model, BrdfModel::lambert);
    expect_near(leaf.diffuse, {0, 0.5f, 0}, 0);
}

TEST_F(Materials, MediaBecomeDiffuse) {
    const std::string message = ": subsurface scattering is replaced by a diffuse surface under a clear coat";
    // Without absorption all light comes back, without scattering none.
    EXPECT_EQ(medium_albedo(0, 3), 1);
    EXPECT_EQ(medium_albedo(3, 0), 0);
    EXPECT_EQ(medium_albedo(0, 0), 0);
    // x = sqrt(3 / 2) for equal coefficients: (1 + e^(-4x/3)) e^-x / 4.
    EXPECT_NEAR(medium_albedo(2, 2), 0.0878078, 1e-6);
    const Material skin = warned("Material \"subsurface\" \"rgb sigma_a\" [0 2 1] \"rgb sigma_s\" [1 4 0] "
                                 "\"float g\" 0.5 \"float eta\" 1.5",
                                 "\"subsurface\"" + message);
    expect_near(skin.diffuse, {1, 0.0878078f, 0}, 1e-6f);
    expect_near(skin.f0, {0.04f, 0.04f, 0.04f}, 1e-6f);
    expect_near(
        warned("Material \"subsurface\" \"rgb reflectance\" [0.1 0.2 0.3]", "\"subsurface\"" + message)
            .diffuse,
        {0.1f, 0.2f, 0.3f}, 0);
    expect_near(
        warned("Material \"kdsubsurface\" \"rgb Kd\" [0.1 0.2 0.3]", "\"kdsubsurface\"" + message).diffuse,
        {0.1f, 0.2f, 0.3f}, 0);
}

TEST_F(Materials, UnknownOnesBecomeLambertian) {
    const std::string message = ": not supported; a Lambertian surface replaces it";
    const Material hair = warned("Material \"hair\" \"float beta_m\" 0.3", "\"hair\"" + message);
    EXPECT_EQ(hair.model, BrdfModel::lambert);
    expect_near(hair.diffuse, {0.5f, 0.5f, 0.5f}, 0);
    expect_near(warned("Material \"measured\" \"rgb color\" [0 0 1]", "\"measured\"" + message).diffuse,
                {0, 0, 1}, 0);
}

TEST_F(Materials, NamedOnesAreReducedOnceAndOnlyIfUsed) {
    const Scene scene = load(R"(Camera "perspective" WorldBegin
        MakeNamedMaterial "mirror" "string type" "mirror"
        MakeNamedMaterial "blue" "string type" "diffuse" "rgb reflectance" [0 0 1]
        MakeNamedMaterial "plain"
        NamedMaterial "blue" )" +
                             std::string(kTriangle) + std::string(kTriangle) + "NamedMaterial \"plain\" " +
                             std::string(kTriangle) + "NamedMaterial \"blue\" " + std::string(kTriangle));
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].name, "blue");
    EXPECT_EQ(scene.materials[1].name, "plain");
    EXPECT_EQ(scene.triangle_material, (std::vector<std::uint32_t>{0, 0, 1, 0}));
    EXPECT_EQ(error("\n\nNamedMaterial \"green\""), "scene.pbrt:3: material \"green\" is not defined");
}

TEST_F(Materials, RedefinitionAppliesFromThere) {
    const Scene scene = load(
        "Camera \"perspective\"\nMakeNamedMaterial \"a\" NamedMaterial \"a\"\n" + std::string(kTriangle) +
        "MakeNamedMaterial \"a\" \"string type\" \"matte\" \"rgb Kd\" [1 1 1] NamedMaterial \"a\"\n" +
        std::string(kTriangle));
    EXPECT_EQ(warning(scene),
              "scene.pbrt:4: material \"a\" is defined again; the new one applies from here on");
    EXPECT_EQ(scene.materials.at(0).diffuse.x, 0.5f);
    EXPECT_EQ(scene.materials.at(1).diffuse.x, 1);
}

TEST_F(Materials, ReflectancesAboveOneAreClamped) {
    const Scene scene = with("Material \"substrate\" \"rgb Ks\" [2 0.5 0.5] \"rgb Kd\" [1 1 1]");
    EXPECT_EQ(scene.materials.at(0).f0.x, 1);
    EXPECT_EQ(scene.materials.at(0).diffuse.x, 0);
    EXPECT_EQ(scene.materials.at(0).diffuse.y, 0.5f);
    EXPECT_NE(warning(scene).find("Ks above 1 is clamped to 1"), std::string::npos) << warning(scene);
}

TEST_F(Materials, ErrorsAndIgnoredParameters) {
    EXPECT_EQ(error("Material \"plastic\"\n\"float roughness\" -0.5\n" + std::string(kTriangle)),
              "scene.pbrt:2: material \"plastic\": roughness must not be negative, found -0.5");
    EXPECT_NE(
        error("Material \"coatedconductor\"\n\"float conductor.roughness\" -1\n" + std::string(kTriangle))
            .find("roughness must not be negative, found -1"),
        std::string::npos);
    EXPECT_NE(error("Material \"matte\" \"rgb Kd\" [-1 5 2]\n" + std::string(kTriangle))
                  .find("Kd must not be negative, found -1"),
              std::string::npos);
    warned("Material \"matte\" \"float Kd\" 0.5", "\"matte\": parameter \"float Kd\" is unknown and ignored");
}

} // namespace
} // namespace nusselt::scene
