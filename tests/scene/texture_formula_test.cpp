// Formulas of textures: what is computed at once, and the grids on which the rest is baked.

#include "scene/build/textures/texture_domain.h"
#include "scene_fixture.h"

#include <array>
#include <stb/stb_image_write.h>

namespace nusselt::scene {
namespace {

TextureNode image_node(int image) {
    TextureNode node;
    node.operation = TextureOperation::image;
    node.image = image;
    return node;
}

TEST(TextureFormulas, ConstantsAreComputedAtOnce) {
    TextureFormulas formulas;
    const TextureValue a{{1, 0.5f, 0}, -1};
    const TextureValue b{{0, 0.5f, 2}, -1};
    expect_near(formulas.product(a, b).factor, {0, 0.25f, 0}, 0);
    expect_near(formulas.mix(a, b, {{0.5f, 0.25f, 1}, -1}).factor, {0.5f, 0.5f, 2}, 0);
    expect_near(formulas.inverted(b).factor, {1, 0.5f, 0}, 0);
    expect_near(formulas.roughness(grey_value(0.25), RoughnessRule::alpha).factor, {0.5f, 0.5f, 0.5f}, 0);
    EXPECT_TRUE(formulas.nodes().empty());
}

TEST(TextureFormulas, FactorsStayApartFromImages) {
    TextureFormulas formulas;
    const TextureValue image = formulas.add(image_node(0));
    const TextureValue half = formulas.product(grey_value(0.5), image);
    EXPECT_EQ(half.node, image.node);
    expect_near(half.factor, {0.5f, 0.5f, 0.5f}, 0);
    // 0.25 image + 0.75 half image, image and black, black and half image
    expect_near(formulas.mix(image, half, grey_value(0.75)).factor, {0.625f, 0.625f, 0.625f}, 0);
    expect_near(formulas.mix(image, grey_value(0), grey_value(0.75)).factor, {0.25f, 0.25f, 0.25f}, 0);
    expect_near(formulas.mix(grey_value(0), half, grey_value(0.75)).factor, {0.375f, 0.375f, 0.375f}, 0);
    EXPECT_EQ(formulas.mix(image, image, half).node, image.node);
    EXPECT_EQ(formulas.product(image, grey_value(0)).node, -1);
    EXPECT_EQ(formulas.nodes().size(), 1u);
}

TEST(TextureFormulas, EqualOnesAreOneNode) {
    TextureFormulas formulas;
    const TextureValue a = formulas.add(image_node(0));
    const TextureValue b = formulas.add(image_node(1));
    EXPECT_EQ(formulas.add(image_node(0)).node, a.node);
    EXPECT_NE(a.node, b.node);
    EXPECT_EQ(formulas.product(a, b).node, formulas.product(b, a).node);
    EXPECT_EQ(formulas.inverted(a).node, formulas.inverted(a).node);
    EXPECT_NE(formulas.roughness(a, RoughnessRule::v3).node, formulas.roughness(a, RoughnessRule::v4).node);
}

TEST(TextureFormulas, NodesAreCountedOnce) {
    TextureFormulas formulas;
    TextureValue power = formulas.add(image_node(0));
    // The formula has more than 10^9 leaves if it is written as a tree.
    for (int i = 0; i < 30; ++i) power = formulas.product(power, power);
    EXPECT_EQ(formula_nodes(formulas.nodes(), power.node).size(), 31u);
}

class TextureDomains : public testing::Test {
protected:
    int leaf(float u_scale, float v_scale, float u_offset = 0, TextureWrap wrap = TextureWrap::repeat) {
        TextureNode node = image_node(0);
        node.mapping = {{u_scale, v_scale}, {u_offset, 0}};
        node.wrap = wrap;
        nodes_.push_back(node);
        return static_cast<int>(nodes_.size()) - 1;
    }
    TextureDomain find(const std::vector<int>& leaves, const std::array<int, 2>& size) const {
        return find_domain(nodes_, leaves, std::vector<std::array<int, 2>>(leaves.size(), size));
    }
    std::vector<TextureNode> nodes_;
};

TEST_F(TextureDomains, OneLeafKeepsItsGrid) {
    const TextureDomain domain = find({leaf(3, -2, 0.25f, TextureWrap::black)}, {5, 7});
    EXPECT_EQ(domain.mapping, (TextureMapping{{3, -2}, {0.25f, 0}}));
    EXPECT_EQ(domain.size, (std::array{5, 7}));
    EXPECT_EQ(domain.wrap, TextureWrap::black);
    EXPECT_EQ(domain.filter, TextureFilter::bilinear);
    EXPECT_TRUE(domain.misfits.empty());
}

TEST_F(TextureDomains, TheCommonPeriodIsTheLongest) {
    const int a = leaf(6, 1);
    const int b = leaf(2, -3, 0.5f);
    const int constant_along_u = leaf(0, 1);
    const TextureDomain domain = find({a, b, constant_along_u}, {4, 8});
    EXPECT_EQ(domain.mapping, (TextureMapping{{2, 1}, {0, 0}}));
    EXPECT_EQ(domain.size, (std::array{12, 24}));
    EXPECT_TRUE(domain.misfits.empty());
    EXPECT_FALSE(domain.is_coarse);
}

TEST_F(TextureDomains, MisfitsAreNamed) {
    const int a = leaf(2, 1);
    const int b = leaf(3, 1);
    const int c = leaf(1, 1, 0, TextureWrap::clamp);
    const int d = leaf(4, 1);
    EXPECT_EQ(find({a, b, c, d}, {4, 4}).misfits, (std::vector<int>{b, c}));
    EXPECT_EQ(find({c, a}, {4, 4}).misfits, (std::vector<int>{a}));
    const int moved = leaf(1, 1, 0.5f, TextureWrap::clamp);
    EXPECT_EQ(find({c, moved, c}, {4, 4}).misfits, (std::vector<int>{moved}));
}

TEST_F(TextureDomains, GridsAreLimited) {
    const TextureDomain domain = find({leaf(1, 1), leaf(1e6f, 1)}, {100, 4});
    EXPECT_EQ(domain.size, (std::array{2048, 4}));
    EXPECT_TRUE(domain.is_coarse);
    // Images themselves may be larger.
    const TextureDomain large = find({leaf(1, 1)}, {5000, 4});
    EXPECT_EQ(large.size, (std::array{5000, 4}));
    EXPECT_FALSE(large.is_coarse);
}

class BakedTextures : public SceneTest {
protected:
    BakedTextures() {
        std::vector<unsigned char> codes;
        for (int i = 0; i < 16; ++i) codes.push_back(static_cast<unsigned char>(i * 17));
        EXPECT_NE(stbi_write_png((folder_ / "ramp.png").c_str(), 16, 1, 1, codes.data(), 16), 0);
    }
    Texture baked(const std::string& textures) const {
        const Scene scene = load("Camera \"perspective\" WorldBegin\n" + textures +
                                 "Material \"matte\" \"texture Kd\" \"t\"\n" + std::string(kTriangle));
        EXPECT_TRUE(scene.warnings.empty());
        return scene.textures.at(0);
    }
    static std::string image(const std::string& name, const std::string& parameters) {
        return "Texture \"" + name + "\" \"spectrum\" \"imagemap\" \"string filename\" \"ramp.png\" " +
               "\"string encoding\" \"linear\" " + parameters + "\n";
    }
};

TEST_F(BakedTextures, OffsetsAreKept) {
    // Both images have the same mapping: the product is that of their texels, wherever they are.
    const std::string mapping = "\"float uscale\" 3 \"float udelta\" 0.3";
    const Texture squares =
        baked(image("a", mapping) + "Texture \"t\" \"spectrum\" \"scale\" \"texture tex1\" \"a\" "
                                    "\"texture tex2\" \"a\"\n");
    ASSERT_EQ(squares.width, 16);
    for (std::size_t i = 0; i < 16; ++i) {
        const auto x = static_cast<float>(i) / 15;
        EXPECT_NEAR(squares.texels[3 * i], x * x, 1e-6f);
    }
}

TEST_F(BakedTextures, MovedImagesAreResampledBilinearly) {
    // The shift is half a texel, so the second factor is the mean of neighbours.
    const Texture product =
        baked(image("a", "") + image("b", "\"float udelta\" 0.03125") +
              "Texture \"t\" \"spectrum\" \"scale\" \"texture tex1\" \"a\" \"texture tex2\" \"b\"\n");
    ASSERT_EQ(product.width, 16);
    for (std::size_t i = 0; i < 16; ++i) {
        const double x = static_cast<double>(i) / 15;
        const double next = static_cast<double>((i + 1) % 16) / 15;
        EXPECT_NEAR(product.texels[3 * i], x * 0.5 * (x + next), 1e-6);
    }
}

TEST_F(BakedTextures, RoughnessDoesNotEndInAMirror) {
    const Scene scene = load("Camera \"perspective\" WorldBegin\n"
                             "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"ramp.png\" "
                             "\"string wrap\" \"black\"\nMaterial \"plastic\" \"texture roughness\" \"t\"\n" +
                             std::string(kTriangle));
    EXPECT_EQ(scene.textures.at(0).wrap, TextureWrap::clamp);
    EXPECT_EQ(scene.textures[0].channels, 1);
    EXPECT_FLOAT_EQ(scene.textures[0].texels.at(0), 0.1f);
}

} // namespace
} // namespace nusselt::scene
