/// Textures in images and in a buffer look like those of the CPU.

#include "comparison.h"
#include "gpu_test.h"
#include "rich_scene.h"
#include "scenes.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace nusselt::render_vulkan_test {
namespace {

using render::Technique;
using render_vulkan::ShadowRays;
using render_vulkan::TextureAccess;
using render_vulkan::VulkanRenderer;
using scene::Float3;

/// The fraction of pixels along edges, as in agreement_test.cpp.
constexpr double kLargestShare = 0.03;

/// Settings without light samples: the image shows textures.
render::RenderSettings unshadowed() {
    render::RenderSettings settings;
    settings.technique = Technique::ltc_analytic;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 1;
    return settings;
}

class Textures : public parity::GpuTest, public testing::WithParamInterface<TextureAccess> {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        if (GetParam() == TextureAccess::images && device().features().indexed_images == 0)
            GTEST_SKIP() << device().description().name << " does not index images";
    }

    image::Image render(const scene::Scene& scene, const render::RenderSettings& settings) const {
        VulkanRenderer renderer(device(), scene, ShadowRays::none, GetParam());
        EXPECT_EQ(renderer.texture_access(), GetParam());
        return renderer.render(settings).image;
    }
};

/// A wall of squares, three pixels each, with a material and a texture of its own for each, lit evenly.
scene::Scene make_wall(int columns, int rows) {
    scene::Scene scene = render_test::make_floor(8);
    scene.positions.clear();
    scene.normals.clear();
    scene.uvs.clear();
    scene.triangles.clear();
    scene.triangle_material.clear();
    scene.triangle_light.clear();
    scene.materials.clear();
    std::uint32_t state = 1;
    const auto random = [&](std::uint32_t count) {
        state = state * 747796405u + 2891336453u;
        return (state >> 16) % count;
    };
    for (int i = 0; i < columns * rows; ++i) {
        // Codes of all sizes: few values, more, and as many as numbers.
        const int side = i % 16 == 0 ? 32 : 1 + static_cast<int>(random(6));
        const std::uint32_t values = i % 16 == 0 ? 400 : i % 3 == 0 ? 3 : 60000;
        scene::Texture texture{.name = "tile", .width = side, .height = side + i % 2};
        texture.channels = i % 5 == 0 ? 1 : 3;
        texture.wrap = i % 7 == 0 ? scene::TextureWrap::clamp : scene::TextureWrap::repeat;
        texture.filter = i % 4 == 0 ? scene::TextureFilter::nearest : scene::TextureFilter::bilinear;
        for (int k = 0; k < texture.width * texture.height * texture.channels; ++k)
            texture.texels.push_back(0.1f +
                                     0.8f * static_cast<float>(random(values)) / static_cast<float>(values));
        scene.textures.push_back(texture);
        scene.materials.push_back({.name = "tile", .diffuse = {1, 1, 1}, .diffuse_texture = {i}});
        const auto x = static_cast<float>(i % columns);
        const auto y = static_cast<float>(i / columns);
        const std::size_t first = scene.positions.size();
        render_test::add_quad(scene, {Float3{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}}, i);
        for (std::size_t k = 0; k < 4; ++k)
            scene.uvs[first + k] = {k == 1 || k == 2 ? 1.3f : -0.2f, k >= 2 ? 1.1f : -0.4f};
    }
    const auto width = static_cast<float>(columns);
    const auto height = static_cast<float>(rows);
    render_test::add_polygon_light(scene,
                                   {Float3{-width, -height, height},
                                    {-width, 2 * height, height},
                                    {2 * width, 2 * height, height},
                                    {2 * width, -height, height}},
                                   {1, 1, 1}, true, 0);
    scene.film.width = 3 * columns;
    scene.film.height = 3 * rows;
    // Between wall and light.
    scene.camera = {.origin = {0, 0, 1},
                    .origin_right = {1.0f / 3, 0, 0},
                    .origin_down = {0, 1.0f / 3, 0},
                    .corner = {0, 0, -1},
                    .right = {0, 0, 0},
                    .down = {0, 0, 0}};
    render_test::set_radius(scene);
    return scene;
}

/// Compares surfaces seen by the camera: whether a shadow ray meets a partially opaque surface depends on all its bits.
TEST_P(Textures, OfEveryWrap_Filter_AndUse_AreThoseOfTheCpu) {
    const scene::Scene scene = make_rich_scene(64, 48);
    EXPECT_LT(differing_share(render(scene, unshadowed()), render_on_cpu(scene, unshadowed())),
              kLargestShare);
}

TEST_P(Textures, MayBeThousands) {
    const scene::Scene scene = make_wall(64, 63);
    EXPECT_EQ(scene.textures.size(), 4032u);
    EXPECT_LT(differing_share(render(scene, unshadowed()), render_on_cpu(scene, unshadowed())),
              kLargestShare);
}

/// Two, each more than buffers may have on software devices, and together more than a block of memory.
TEST_P(Textures, MayBeLarge) {
    constexpr int kSide = 6011;
    constexpr std::size_t kCount = std::size_t{kSide} * kSide;
    scene::Scene scene = make_wall(2, 2);
    for (std::size_t i = 2; i < 4; ++i) {
        scene::Texture& texture = scene.textures[i];
        texture.width = texture.height = kSide;
        texture.channels = 1;
        texture.texels.clear();
        texture.texels.reserve(kCount);
        for (std::size_t k = 0; k < kCount; ++k)
            texture.texels.push_back(0.2f + 0.6f * static_cast<float>((k + i) * 7919 % kCount) /
                                                static_cast<float>(kCount));
    }
    scene.film.width = scene.film.height = 60;
    scene.camera.origin_right.x = scene.camera.origin_down.y = 1.0f / 30;
    const std::size_t most = device().limits().maxStorageBufferRange;
    if (GetParam() == TextureAccess::buffer && most < 2 * kCount * sizeof(float)) {
        EXPECT_THROW(render(scene, unshadowed()), gpu::Error);
        return;
    }
    EXPECT_LT(differing_share(render(scene, unshadowed()), render_on_cpu(scene, unshadowed())),
              kLargestShare);
}

/// The test of the tests.
TEST_P(Textures, OfTheNextMaterial_AreFound) {
    scene::Scene scene = make_wall(32, 32);
    const image::Image reference = render_on_cpu(scene, unshadowed());
    for (scene::Material& material : scene.materials)
        material.diffuse_texture.texture = (material.diffuse_texture.texture + 1) % 1024;
    EXPECT_GT(differing_share(render(scene, unshadowed()), reference), 0.5);
}

/// Likewise.
TEST_P(Textures, WithAnotherWrap_OrASingleOtherTexel_AreFound) {
    const scene::Scene scene = make_wall(32, 32);
    const image::Image reference = render_on_cpu(scene, unshadowed());
    scene::Scene wrapped = scene;
    for (scene::Texture& texture : wrapped.textures) texture.wrap = scene::TextureWrap::black;
    EXPECT_GT(differing_share(render(wrapped, unshadowed()), reference), 2 * kLargestShare);
    scene::Scene shifted = scene;
    for (scene::Texture& texture : shifted.textures)
        std::rotate(texture.texels.begin(), texture.texels.begin() + texture.channels, texture.texels.end());
    EXPECT_GT(differing_share(render(shifted, unshadowed()), reference), 0.5);
}

std::string access_name(const testing::TestParamInfo<TextureAccess>& info) {
    return std::string(name_of(info.param));
}

INSTANTIATE_TEST_SUITE_P(By, Textures, testing::Values(TextureAccess::images, TextureAccess::buffer),
                         access_name);

class TextureChoice : public parity::GpuTest {};

TEST_F(TextureChoice, TakesImagesWhereTheDeviceHasThem) {
    const bool has_images = device().features().indexed_images > 0;
    const scene::Scene scene = make_rich_scene(8, 8);
    VulkanRenderer renderer(device(), scene, ShadowRays::none);
    EXPECT_EQ(renderer.texture_access(), has_images ? TextureAccess::images : TextureAccess::buffer);
    if (!has_images) {
        EXPECT_THROW(VulkanRenderer(device(), scene, ShadowRays::none, TextureAccess::images), gpu::Error);
    }
}

/// On one device, the same bits of shadow rays meet the same partially opaque surfaces.
TEST_F(TextureChoice, ChangesNothing) {
    if (device().features().indexed_images == 0)
        GTEST_SKIP() << device().description().name << " does not index images";
    scene::Scene scene = make_rich_scene(64, 48);
    // Drivers take long for all kinds of lights.
    scene.lights.of<scene::LineLight>().clear();
    render::RenderSettings settings;
    settings.samples = 2;
    for (const ShadowRays way : {ShadowRays::query, ShadowRays::bvh}) {
        if (way == ShadowRays::query && !device().features().ray_queries) continue;
        SCOPED_TRACE(name_of(way));
        VulkanRenderer by_images(device(), scene, way, TextureAccess::images);
        VulkanRenderer by_buffer(device(), scene, way, TextureAccess::buffer);
        EXPECT_LT(differing_share(by_images.render(settings).image, by_buffer.render(settings).image), 0.001);
    }
}

/// A texture that is wider than images may be.
TEST_F(TextureChoice, TakesTheBufferForWhatImagesCannotHold) {
    scene::Scene scene = make_wall(2, 2);
    scene::Texture& texture = scene.textures[2];
    texture.width = static_cast<int>(device().limits().maxImageDimension2D) + 1;
    texture.height = 1;
    texture.texels.assign(static_cast<std::size_t>(texture.width * texture.channels), 0.5f);
    texture.texels.front() = 0.25f;
    VulkanRenderer renderer(device(), scene, ShadowRays::none);
    EXPECT_EQ(renderer.texture_access(), TextureAccess::buffer);
    EXPECT_LT(differing_share(renderer.render(unshadowed()).image, render_on_cpu(scene, unshadowed())),
              kLargestShare);
    EXPECT_THROW(VulkanRenderer(device(), scene, ShadowRays::none, TextureAccess::images), gpu::Error);
}

} // namespace
} // namespace nusselt::render_vulkan_test
