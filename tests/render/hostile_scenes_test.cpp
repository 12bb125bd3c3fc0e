/// Degenerate geometry, lights and views: every pixel is finite and not negative, and no sample was rejected to
/// make it so.

#include "lights/round_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace nusselt::render_test {
namespace {

constexpr int kSize = 24;

using render::RenderSettings;

/// All ways to sample lights, with all ways to combine the samples.
std::vector<RenderSettings> all_settings() {
    std::vector<RenderSettings> all;
    for (const auto technique : render::kTechniques)
        for (const auto strategies : render::kStrategies)
            for (const auto mis : render::kMisHeuristics) {
                if (!allows(technique, strategies) || !allows(strategies, mis)) continue;
                // One technique leaves nothing to combine.
                if (strategies == render::Strategies::diffuse && mis != RenderSettings().mis) continue;
                RenderSettings settings;
                settings.technique = technique;
                settings.strategies = strategies;
                settings.mis = mis;
                all.push_back(settings);
            }
    for (const auto orientation : render::kLineOrientations)
        for (const auto offsets : render::kLineOffsets)
            for (const auto shading : render::kLineShadings) {
                RenderSettings settings;
                settings.light_samples = render::LightSamples::lines;
                settings.lines = {5, orientation, offsets, shading, render::ManyOccluders::lines};
                all.push_back(settings);
            }
    return all;
}

std::string description_of(const RenderSettings& settings) {
    if (settings.light_samples == render::LightSamples::lines)
        return std::string("lines, ")
            .append(name_of(settings.lines.orientation))
            .append(", ")
            .append(name_of(settings.lines.offsets))
            .append(", ")
            .append(name_of(settings.lines.shading));
    std::string text(name_of(settings.technique));
    for (const auto name : {name_of(settings.strategies), name_of(settings.mis)})
        text.append(", ").append(name);
    return text;
}

void expect_sane_images(const scene::Scene& scene) {
    const render_cpu::Renderer renderer(scene, 2);
    for (const base::Isa isa : base::kAllIsas) {
        if (!is_supported(isa)) continue;
        for (RenderSettings settings : all_settings()) {
            settings.samples = 4;
            const bool has_lines = settings.light_samples == render::LightSamples::lines;
            const bool may_be_negative =
                settings.mis == render::Mis::optimal ||
                (has_lines && settings.lines.shading == render::LineShading::unbiased);
            const render::RenderResult result = renderer.render(settings, isa);
            ASSERT_EQ(result.statistics.rejected_samples, 0u)
                << description_of(settings) << ", " << name_of(isa);
            for (const float value : result.image.pixels)
                ASSERT_TRUE(std::isfinite(value) && (may_be_negative || value >= 0))
                    << value << " with " << description_of(settings) << ", " << name_of(isa);
        }
    }
}

TEST(HostileScenes, RoundLights) {
    using scene::RoundModel;
    const auto add = [](scene::Scene& scene, const Float3& center, const Float3& u, const Float3& v,
                        const Float3& w) {
        for (const bool two_sided : {false, true})
            add_round_light(scene, {.model = w == Float3{0, 0, 0} ? RoundModel::ellipse
                                             : two_sided          ? RoundModel::hollow
                                                                  : RoundModel::ellipsoid,
                                    .center = center,
                                    .u = u,
                                    .v = v,
                                    .w = w,
                                    .radiance = {1, 1, 1},
                                    .two_sided = two_sided});
    };
    const Float3 none = {0, 0, 0};
    scene::Scene scene = make_floor(kSize);
    scene.materials[0].model = scene::BrdfModel::frostbite;
    scene.materials[0].roughness = 0.1f;
    for (const float size : {1e-8f, 0.3f, 1e6f}) {
        const Float3 x = {size, 0, 0}, y = {0, size, 0}, z = {0, 0, size};
        add(scene, {0, 0, size}, x, y, z);         // touches the floor
        add(scene, {0.1f, 0.2f, 0}, x, y, z);      // half below
        add(scene, {0, 0, 0}, x, y, none);         // in the floor
        add(scene, {0.3f, 0, 0}, x, z, none);      // seen edge-on from a line of the floor
        add(scene, {0, 0, -2 * size}, x, y, none); // below
    }
    add(scene, {0, 0, 0.5f}, {1, 0, 0}, {0, 1e-4f, 0}, {0, 0, 1e-4f});
    add(scene, {0, 0, 0.5f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-4f});
    add(scene, {0, 0, 1e7f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    set_radius(scene);
    expect_sane_images(scene);
}

TEST(HostileScenes, Nothing) {
    scene::Scene scene;
    set_camera(scene, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.5, kSize, kSize);
    expect_sane_images(scene);
}

TEST(HostileScenes, DegenerateTriangles) {
    scene::Scene scene = make_box_scene(kSize);
    const Float3 p{0, 0, 1};
    add_quad(scene, {p, p, p, p}, 0);
    add_quad(scene, {Float3{-1, 0, 1}, Float3{0, 0, 1}, Float3{1, 0, 1}, Float3{0.5f, 0, 1}}, 0);
    add_quad(scene, {Float3{-1, 0, 1}, Float3{1, 0, 1}, Float3{1, 0, 1 + 1e-7f}, Float3{-1, 0, 1 + 1e-7f}},
             1);
    expect_sane_images(scene);
}

TEST(HostileScenes, DegenerateLights) {
    scene::Scene scene = make_box_scene(kSize);
    const Float3 radiance{3, 3, 3};
    const Float3 p{0, 0, 1};
    add_polygon_light(scene, {p, p, p, p}, radiance, true, 0);
    add_polygon_light(scene, {p, Float3{0.5f, 0, 1}, Float3{1, 0, 1}, Float3{0.2f, 0, 1}}, radiance, true, 0);
    // One light lies on the floor, the other one passes through it.
    add_polygon_light(
        scene,
        {Float3{-0.5f, -0.5f, 0}, Float3{0.5f, -0.5f, 0}, Float3{0.5f, 0.5f, 0}, Float3{-0.5f, 0.5f, 0}},
        radiance, true, 1);
    add_polygon_light(scene,
                      {Float3{0, -0.5f, -1}, Float3{0, 0.5f, -1}, Float3{0, 0.5f, 1}, Float3{0, -0.5f, 1}},
                      radiance, true, 1);
    for (const scene::TubeModel model : {scene::TubeModel::linear, scene::TubeModel::solid,
                                         scene::TubeModel::open, scene::TubeModel::strip}) {
        const Float3 normal{0, 1, 0};
        add_line_light(scene, "point", {0, p, p, 0.01f, radiance, model, normal});
        add_line_light(scene, "no radius", {0, p, {1, 0, 1}, 0, radiance, model, normal});
        add_line_light(scene, "on the floor", {0, {-1, -1, 0}, {1, 1, 0}, 0.01f, radiance, model, {0, 0, 1}});
        add_line_light(scene, "through the floor",
                       {0, {0.3f, 0.2f, -1}, {0.3f, 0.2f, 1}, 0.01f, radiance, model, normal});
    }
    expect_sane_images(scene);
}

TEST(HostileScenes, LightWithEightCornersOneOfThemRepeated) {
    scene::Scene scene = make_floor(kSize);
    scene::PolygonLight light;
    for (int j = 0; j < 7; ++j) {
        const float angle = 0.897f * static_cast<float>(j);
        light.vertices.push_back({std::cos(angle), std::sin(angle), 0.5f});
    }
    light.vertices.push_back(light.vertices.back());
    light.radiance = {1, 1, 1};
    light.two_sided = true;
    scene.emitters.push_back({"octagon"});
    scene.lights.of<scene::PolygonLight>().push_back(light);
    expect_sane_images(scene);
}

TEST(HostileScenes, CameraInThePlaneOfALight) {
    scene::Scene scene = make_box_scene(kSize);
    add_polygon_light(
        scene, {Float3{-0.5f, -1.5f, 1}, Float3{0.5f, -1.5f, 1}, Float3{0.5f, 1, 1}, Float3{-0.5f, 1, 1}},
        {2, 2, 2}, true, 0);
    set_camera(scene, {0, -4, 1}, {0, 0, 1}, {0, 0, 1}, 0.3, kSize, kSize);
    expect_sane_images(scene);
    // And on the light.
    set_camera(scene, {0, -1, 1}, {0, 0, 1}, {0, 0, 1}, 0.3, kSize, kSize);
    expect_sane_images(scene);
}

TEST(HostileScenes, ShadingNormalsOfAllKinds) {
    scene::Scene scene = make_box_scene(kSize);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Float3 kinds[] = {{0, 0, 0},    {0, 0, -1}, {1, 0, 0}, {nan, 0, 1}, {1e-30f, 1e-30f, 1e-30f},
                            {1e30f, 0, 1}};
    for (std::size_t i = 0; i < scene.normals.size(); ++i) scene.normals[i] = kinds[i * 7 % std::size(kinds)];
    expect_sane_images(scene);
}

TEST(HostileScenes, TextureCoordinatesOfAllKinds) {
    scene::Scene scene = make_box_scene(kSize);
    scene.textures.push_back({"checker", 2, 1, {1, 1, 1, 0, 0, 0}});
    for (const auto wrap : {scene::TextureWrap::clamp, scene::TextureWrap::black}) {
        scene.textures.push_back(scene.textures[0]);
        scene.textures.back().wrap = wrap;
    }
    scene::Material& matte = scene.materials.at(0);
    scene::Material& glossy = scene.materials.at(1);
    matte.diffuse_texture.texture = 0;
    matte.normal_texture.texture = 1;
    glossy.diffuse_texture.texture = 1;
    glossy.f0_texture.texture = 2;
    glossy.roughness_texture = {0, {1e30f, 1e-30f}, {0, 0}};
    glossy.bump_texture = {2, {-3, 1e10f}, {0.5f, 0}};
    const float infinity = std::numeric_limits<float>::infinity();
    const float kinds[] = {0, -1e-9f, 1e9f, -infinity, infinity, std::nanf(""), 0.5f};
    for (std::size_t i = 0; i < scene.uvs.size(); ++i)
        scene.uvs[i] = {kinds[i % std::size(kinds)], kinds[i * 3 % std::size(kinds)]};
    expect_sane_images(scene);
}

TEST(HostileScenes, AlphaOfAllKinds) {
    scene::Scene scene = make_box_scene(kSize);
    const float infinity = std::numeric_limits<float>::infinity();
    const float kinds[] = {0, -1e-9f, 1e30f, -infinity, infinity, std::nanf(""), 0.5f};
    for (std::size_t i = 0; i < scene.uvs.size(); ++i)
        scene.uvs[i] = {kinds[i % std::size(kinds)], kinds[i * 3 % std::size(kinds)]};
    for (const auto wrap :
         {scene::TextureWrap::repeat, scene::TextureWrap::clamp, scene::TextureWrap::black}) {
        scene::Texture texture;
        texture.width = 2;
        texture.height = 1;
        texture.channels = 1;
        texture.wrap = wrap;
        texture.texels = {2, 0.3f};
        scene.textures.push_back(texture);
    }
    for (const float alpha : {1.0f, 1e30f, -1.0f, std::nanf("")}) {
        for (std::size_t i = 0; i < scene.materials.size(); ++i) {
            scene.materials[i].alpha = alpha;
            scene.materials[i].alpha_texture.texture = static_cast<int>(i % 3);
        }
        expect_sane_images(scene);
    }
}

TEST(HostileScenes, InstancesOfAllSizes) {
    scene::Scene scene = make_box_scene(kSize);
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    add_quad(scene, {Float3{-1, 0, -1}, Float3{1, 0, -1}, Float3{1, 0.5f, 1}, Float3{-1, 0, 1}}, 1);
    for (std::size_t i = scene.normals.size() - 4; i < scene.normals.size(); ++i)
        scene.normals[i] = {0.1f * static_cast<float>(i % 3), 1, 0};
    scene.objects.push_back({"quad", first, 2});
    for (const float x : {1e-15f, 1e-6f, 1.0f, -1e3f, 1e15f})
        for (const float y : {1e-15f, 1e-3f, -1.0f, 1e15f})
            for (const float z : {1e-9f, -1.0f, 1e9f})
                scene.instances.push_back({0, {x, 0, 0, 0.1f, 0, y, 0.5f, -0.5f, 0, 0, z, 1}});
    scene.instances.push_back({0, {1, 0, 0, 1e15f, 0, 1, 0, 0, 0, 0, 1, 0}});
    expect_sane_images(scene);
}

TEST(HostileScenes, SizesThatFillNoTile) {
    for (const auto& [width, height] : {std::pair{1, 1}, {17, 3}, {3, 33}}) {
        scene::Scene scene = make_box_scene(kSize);
        set_camera(scene, {0, -4, 1}, {0, 0, 1}, {0, 0, 1}, 0.3, width, height);
        expect_sane_images(scene);
    }
}

/// Expects that a spoiled scene has pixels without NaN and infinity, and that some samples were rejected for that.
void expect_rejections(const scene::Scene& spoiled, const RenderSettings& settings, const std::string& what) {
    const render_cpu::Renderer renderer(spoiled, 2);
    const auto result = renderer.render(settings, base::choose_isa());
    EXPECT_GT(result.statistics.rejected_samples, 0u) << what << ", " << description_of(settings);
    for (const float value : result.image.pixels) ASSERT_TRUE(std::isfinite(value)) << what;
}

// The tests of the test: NaN and infinity in materials do not reach the image, but are counted.

TEST(HostileScenes, RejectedSamplesOfDiffuseSurfacesAreCounted) {
    for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()})
        for (float Float3::*const channel : {&Float3::x, &Float3::z}) {
            scene::Scene scene = make_box_scene(kSize);
            scene.materials[0].diffuse.*channel = bad;
            for (const RenderSettings& settings : all_settings()) {
                // Two techniques take what is beyond all floats for a light that almost meets the point.
                if (std::isinf(bad) && settings.strategies != render::Strategies::diffuse) continue;
                expect_rejections(scene, settings, "diffuse albedo " + std::to_string(bad));
            }
        }
}

TEST(HostileScenes, RejectedSamplesOfGlossySurfacesAreCounted) {
    for (float Float3::*const channel : {&Float3::x, &Float3::z}) {
        scene::Scene scene = make_box_scene(kSize);
        scene.materials[1].f0.*channel = std::nanf("");
        for (const RenderSettings& settings : all_settings()) {
            // The table of lobes, all that it knows of f0, takes NaN for 0.
            if (settings.technique == render::Technique::ltc_analytic) continue;
            expect_rejections(scene, settings, "f0 NaN");
        }
    }
}

} // namespace
} // namespace nusselt::render_test
