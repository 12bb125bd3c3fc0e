/// Tubes, lines and strips whose radiance varies along them: what cameras see and surfaces reflect, whichever technique samples
/// them. Many short lights of uniform radiance are the reference.

#include "lossy_tracer.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace nusselt::render_test {
namespace {

using render::EmissionSampling;
using render::RenderSettings;
using render::Technique;
using scene::LineLight;
using scene::TubeModel;

constexpr int kFloorSize = 8;
constexpr TubeModel kModels[] = {TubeModel::linear, TubeModel::solid, TubeModel::open, TubeModel::strip};

/// Dark, with some bright parts, all of another colour; black at the start.
std::vector<Float3> make_texels() {
    std::vector<Float3> texels;
    for (int k = 0; k < 20; ++k) {
        const float brightness = k < 3 ? 0.0f : k % 5 == 0 ? 8.0f : 0.5f;
        texels.push_back({brightness, brightness * static_cast<float>(k) / 20, brightness * 0.3f});
    }
    return texels;
}

/// The radiance that the texels have at a place in [0, 1].
Float3 radiance_at(const std::vector<Float3>& texels, double at) {
    const double count = static_cast<double>(texels.size());
    const double x = std::clamp(at * count - 0.5, 0.0, count - 1);
    const auto k = static_cast<std::size_t>(std::min(x, count - 2));
    const auto share = static_cast<float>(x - static_cast<double>(k));
    const auto mix = [&](float Float3::*c) {
        return (1 - share) * (texels[k].*c) + share * (texels[k + 1].*c);
    };
    return {mix(&Float3::x), mix(&Float3::y), mix(&Float3::z)};
}

/// Gives a light a texture, whose texels are its radiance.
void set_texture(scene::Scene& scene, LineLight& light, const std::vector<Float3>& texels) {
    Float3 mean = {0, 0, 0};
    for (const Float3& texel : texels) {
        mean.x += texel.x / static_cast<float>(texels.size());
        mean.y += texel.y / static_cast<float>(texels.size());
        mean.z += texel.z / static_cast<float>(texels.size());
    }
    light.texture = static_cast<std::int32_t>(scene.emission_textures.size());
    light.radiance = mean;
    scene.emission_textures.push_back({std::make_shared<const scene::EmissionTexture>(scene::EmissionTexture{
                                           "texture", 1, static_cast<int>(texels.size()), texels}),
                                       {},
                                       mean});
}

LineLight make_light(TubeModel model) {
    return {.start = {-0.5f, 0.1f, 0.15f},
            .end = {0.6f, -0.1f, 0.4f},
            .radius = 0.03f,
            .model = model,
            .normal = {-0.2195121f, 0, 0.9756098f}};
}

scene::Scene make_small_floor() {
    scene::Scene scene = make_floor(kFloorSize);
    set_camera(scene, {0, -0.1f, 0.1f}, {0, 0, 0}, {0, 1, 0}, 3, kFloorSize, kFloorSize);
    return scene;
}

scene::Scene make_textured_floor(TubeModel model, const std::vector<Float3>& texels) {
    scene::Scene scene = make_small_floor();
    LineLight light = make_light(model);
    set_texture(scene, light, texels);
    add_line_light(scene, "light", light);
    return scene;
}

/// The same light as many short ones.
scene::Scene make_divided_floor(TubeModel model, const std::vector<Float3>& texels) {
    // A whole number for each half of a texel.
    constexpr int kParts = 160;
    scene::Scene scene = make_small_floor();
    const LineLight whole = make_light(model);
    const auto point = [&](double at) {
        const auto mix = [&](float Float3::*c) {
            return static_cast<float>((1 - at) * (whole.start.*c) + at * (whole.end.*c));
        };
        return Float3{mix(&Float3::x), mix(&Float3::y), mix(&Float3::z)};
    };
    for (int k = 0; k < kParts; ++k) {
        LineLight part = whole;
        part.start = point(k / double{kParts});
        part.end = point((k + 1) / double{kParts});
        part.radiance = radiance_at(texels, (k + 0.5) / kParts);
        add_line_light(scene, "part", part);
    }
    return scene;
}

RenderSettings make_settings(int samples) {
    RenderSettings settings;
    settings.samples = samples;
    settings.camera_rays = 1;
    settings.pixel_position = render::PixelPosition::center;
    return settings;
}

image::Image render(const scene::Scene& scene, const RenderSettings& settings) {
    const auto result = render_cpu::Renderer(scene, 2).render(settings, base::choose_isa());
    EXPECT_EQ(result.statistics.rejected_samples, 0u);
    return result.image;
}

std::vector<std::vector<double>> rows(const scene::Scene& scene, const RenderSettings& settings) {
    const render_cpu::Renderer renderer(scene, 2);
    return render_region_means(renderer, settings, kSeeds, renderer.visibility().tracer());
}

class TexturedTubeModels : public testing::TestWithParam<TubeModel> {};

/// Without solid tubes: the inner caps of short ones would shine.
class TexturedTubesWithoutCaps : public testing::TestWithParam<TubeModel> {};

TEST_P(TexturedTubesWithoutCaps, LightTheFloorLikeManyShortLights) {
    const std::vector<Float3> texels = make_texels();
    // Seeds depend on the technique.
    RenderSettings settings = make_settings(8);
    settings.technique = Technique::projected_solid_angle_biased;
    const auto expected = rows(make_divided_floor(GetParam(), texels), settings);
    const scene::Scene scene = make_textured_floor(GetParam(), texels);
    settings = make_settings(16);
    for (const auto sampling : render::kEmissionSamplings) {
        settings.emission_sampling = sampling;
        EXPECT_LT(largest_t(rows(scene, settings), expected), kLargestT);
    }
    // The test of the test: a texture that is turned around.
    std::vector<Float3> turned = texels;
    std::reverse(turned.begin(), turned.end());
    EXPECT_GT(largest_t(rows(make_textured_floor(GetParam(), turned), settings), expected), kLargestT);
}

TEST_P(TexturedTubeModels, ProductsHaveLessNoise) {
    const scene::Scene scene = make_textured_floor(GetParam(), make_texels());
    const render_cpu::Renderer renderer(scene, 2);
    RenderSettings settings = make_settings(1);
    settings.sample_order = render::SampleOrder::independent;
    const auto noise = [&](EmissionSampling sampling) {
        settings.emission_sampling = sampling;
        const auto rows = render_region_means(renderer, settings, kSeeds, renderer.visibility().tracer());
        double mean = 0, squares = 0;
        for (std::size_t k = 0; k < rows[0].size(); ++k) {
            double sum = 0, of_squares = 0;
            for (const auto& row : rows) sum += row[k] / kSeeds;
            for (const auto& row : rows) of_squares += (row[k] - sum) * (row[k] - sum) / kSeeds;
            mean += sum;
            squares += of_squares;
        }
        return std::sqrt(squares) / mean;
    };
    const double measure = noise(EmissionSampling::measure);
    const double product = noise(EmissionSampling::product);
    std::printf("noise %.5f with products, %.5f without\n", product, measure);
    EXPECT_LT(product, 0.3 * measure);
}

TEST_P(TexturedTubeModels, AnalyticShadingIsCloseToSamples) {
    const scene::Scene scene = make_textured_floor(GetParam(), make_texels());
    RenderSettings settings = make_settings(256);
    const double sampled = region_means(render(scene, settings), 1)[0];
    settings.technique = Technique::ltc_analytic;
    // Caps and the radius of tubes are approximations.
    EXPECT_NEAR(region_means(render(scene, settings), 1)[0], sampled, 0.03 * sampled);
}

TEST_P(TexturedTubeModels, CamerasSeeTheTexels) {
    const std::vector<Float3> texels = make_texels();
    scene::Scene scene = make_textured_floor(GetParam(), texels);
    const LineLight light = make_light(GetParam());
    for (const double at : {0.05, 0.26, 0.5, 0.97}) {
        const auto mix = [&](float Float3::*c) {
            return static_cast<float>((1 - at) * (light.start.*c) + at * (light.end.*c));
        };
        const Float3 axis = {mix(&Float3::x), mix(&Float3::y), mix(&Float3::z)};
        // Perpendicular to the axis: the point that is seen has the same place along it.
        const Float3 eye = {axis.x - 0.22f * 0.9f, axis.y, axis.z + 0.97f * 0.9f};
        set_camera(scene, eye, axis, {0, 1, 0}, 1e-4, 1, 1);
        const image::Image image = render(scene, make_settings(1));
        const Float3 expected = radiance_at(texels, at);
        EXPECT_NEAR(image.pixels[0], expected.x, 0.05) << at;
        EXPECT_NEAR(image.pixels[1], expected.y, 0.05) << at;
        EXPECT_NEAR(image.pixels[2], expected.z, 0.05) << at;
    }
}

INSTANTIATE_TEST_SUITE_P(Models, TexturedTubesWithoutCaps,
                         testing::Values(TubeModel::linear, TubeModel::open, TubeModel::strip));
INSTANTIATE_TEST_SUITE_P(Models, TexturedTubeModels, testing::ValuesIn(kModels));

/// Both tubes of the box, with matte and glossy surfaces and shadows.
TEST(TexturedTubes, AllWaysToSampleHaveTheSameExpectation) {
    const auto make_scene = [](const std::vector<Float3>& texels) {
        scene::Scene scene = make_box_scene(20);
        for (LineLight& light : scene.lights.of<LineLight>()) set_texture(scene, light, texels);
        scene.lights.of<LineLight>()[0].radiance.x *= 20;
        scene.lights.of<scene::PolygonLight>()[0].radiance = {0, 0, 0};
        return scene;
    };
    const scene::Scene scene = make_scene(make_texels());
    const render_cpu::Renderer renderer(scene, 2);
    const auto tracer = renderer.visibility().tracer();
    RenderSettings settings = make_settings(32);
    const auto rows = [&](const render_cpu::Renderer& r, const visibility::RayTracer& t) {
        return render_region_means(r, settings, kSeeds, t);
    };
    settings.technique = Technique::area;
    const auto reference = rows(renderer, tracer);
    settings.samples = 12;
    settings.technique = Technique::projected_solid_angle;
    EXPECT_LT(largest_t(rows(renderer, tracer), reference), kLargestT);
    settings.strategies = render::Strategies::diffuse_ltc;
    for (const auto mis : render::kMisHeuristics) {
        settings.mis = mis;
        EXPECT_LT(largest_t(rows(renderer, tracer), reference), kLargestT) << render::name_of(mis);
    }
    const LossyTracer mutant(tracer, 0.05);
    EXPECT_GT(largest_t(rows(renderer, mutant.tracer()), reference), kLargestT);
    std::vector<Float3> shifted = make_texels();
    std::rotate(shifted.begin(), shifted.begin() + 1, shifted.end());
    const scene::Scene other_scene = make_scene(shifted);
    const render_cpu::Renderer other(other_scene, 2);
    EXPECT_GT(largest_t(rows(other, other.visibility().tracer()), reference), kLargestT);
}

} // namespace
} // namespace nusselt::render_test
