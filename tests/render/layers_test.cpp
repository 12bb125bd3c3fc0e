/// Layers beside the image add up to it, have the documented contents, and do not change it.

#include "scenes.h"

#include "render/memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace nusselt::render_test {
namespace {

using render::LayerKind;
using render::Mis;
using render::RenderResult;
using render::RenderSettings;
using render::Strategies;
using render::Technique;

constexpr int kSize = 40;

const std::vector<LayerKind> kAllKinds = {render::kLayerKinds.begin(), render::kLayerKinds.end()};

const std::vector<float>& data_of(const RenderResult& result, const std::string& name) {
    for (const image::Layer& layer : result.layers)
        if (layer.name == name) return layer.data;
    throw std::runtime_error("no layer " + name);
}

RenderResult render(const scene::Scene& scene, const RenderSettings& settings) {
    return render_cpu::Renderer(scene, 2).render(settings, base::choose_isa());
}

/// Ways to estimate light, each with another split into components.
struct Case {
    const char* name;
    Technique technique;
    Strategies strategies;
    Mis mis;
    render::LightSamples light_samples = render::LightSamples::points;
};

const Case kCases[] = {
    {"single", Technique::solid_angle, Strategies::diffuse, Mis::balance},
    {"balance", Technique::projected_solid_angle, Strategies::diffuse_ltc, Mis::balance},
    {"power", Technique::projected_solid_angle, Strategies::diffuse_ltc, Mis::power},
    {"weighted", Technique::projected_solid_angle, Strategies::diffuse_ltc, Mis::weighted_balance},
    {"clamped_optimal", Technique::projected_solid_angle, Strategies::diffuse_ltc, Mis::clamped_optimal},
    {"optimal", Technique::projected_solid_angle, Strategies::diffuse_ltc, Mis::optimal},
    {"one_sample", Technique::projected_solid_angle, Strategies::diffuse_ltc, Mis::one_sample},
    {"separate", Technique::projected_solid_angle, Strategies::diffuse_ltc, Mis::separate},
    {"ggx", Technique::projected_solid_angle, Strategies::diffuse_ggx, Mis::balance},
    {"analytic", Technique::ltc_analytic, Strategies::diffuse, Mis::balance},
    {"lines", Technique::projected_solid_angle, Strategies::diffuse_ltc, Mis::balance,
     render::LightSamples::lines},
};

class Layers : public testing::TestWithParam<Case> {
protected:
    static RenderSettings settings() {
        RenderSettings settings;
        settings.technique = GetParam().technique;
        settings.strategies = GetParam().strategies;
        settings.mis = GetParam().mis;
        settings.light_samples = GetParam().light_samples;
        settings.samples = 4;
        settings.camera_rays = 2;
        return settings;
    }
};

/// Every float of the image is the sum of those of the layers.
/// \param least_magnitude where values are smaller, rounding is still that of numbers of this size
void expect_sum(const RenderResult& result, const std::vector<std::string>& names,
                double least_magnitude = 0) {
    for (std::size_t i = 0; i < result.image.pixels.size(); ++i) {
        double sum = 0;
        double magnitude = 0;
        for (const std::string& name : names) {
            sum += data_of(result, name)[i];
            magnitude += std::fabs(data_of(result, name)[i]);
        }
        ASSERT_NEAR(sum, result.image.pixels[i], 1e-6 * std::max(magnitude, least_magnitude)) << i;
    }
}

TEST_P(Layers, DoNotChangeTheImage) {
    const scene::Scene scene = make_box_scene(kSize);
    RenderSettings with_layers = settings();
    with_layers.layers = kAllKinds;
    const RenderResult plain = render(scene, settings());
    EXPECT_TRUE(plain.layers.empty());
    EXPECT_EQ(plain.image.pixels, render(scene, with_layers).image.pixels);
    for (const LayerKind kind : kAllKinds) {
        with_layers.layers = {kind};
        EXPECT_EQ(plain.image.pixels, render(scene, with_layers).image.pixels) << name_of(kind);
    }
}

TEST_P(Layers, OfComponentsAndOfLightsAddUpToTheImage) {
    RenderSettings with_layers = settings();
    with_layers.layers = kAllKinds;
    const RenderResult result = render(make_box_scene(kSize), with_layers);
    expect_sum(result, {"emission", "diffuse", "specular"});
    expect_sum(result, {"light.panel", "light.tube", "light.pipe"});
    for (const char* name : {"emission", "diffuse", "specular", "light.panel", "light.tube", "light.pipe"})
        EXPECT_GT(*std::max_element(data_of(result, name).begin(), data_of(result, name).end()), 0) << name;
}

/// Filters may weigh camera rays, also with negative numbers.
TEST_P(Layers, AddUpWithAnyPixelFilter) {
    scene::Scene scene = make_box_scene(kSize);
    scene.film.filter.kind = scene::FilterKind::mitchell;
    scene.film.filter.radius_x = scene.film.filter.radius_y = 2;
    RenderSettings with_layers = settings();
    with_layers.layers = kAllKinds;
    const RenderResult result = render(scene, with_layers);
    // Camera rays of both signs cancel, their rounding errors do not.
    const double largest = *std::max_element(result.image.pixels.begin(), result.image.pixels.end());
    expect_sum(result, {"emission", "diffuse", "specular"}, largest);
    expect_sum(result, {"light.panel", "light.tube", "light.pipe"}, largest);
}

TEST_P(Layers, LightsAreThoseOfTheSceneWithThatLightAlone) {
    const scene::Scene scene = make_box_scene(kSize);
    RenderSettings with_layers = settings();
    with_layers.layers = {LayerKind::lights};
    const RenderResult result = render(scene, with_layers);
    scene::Scene dark = scene;
    dark.lights.of<scene::PolygonLight>()[0].radiance = {0, 0, 0};
    dark.lights.of<scene::LineLight>()[1].radiance = {0, 0, 0};
    const image::Image alone = render(dark, settings()).image;
    const std::vector<float>& tube = data_of(result, "light.tube");
    for (std::size_t i = 0; i < tube.size(); ++i)
        ASSERT_NEAR(tube[i], alone.pixels[i], 1e-6 * std::fabs(alone.pixels[i])) << i;
}

TEST_P(Layers, MatteSurfacesHaveNoSpecularPartAndMetalsNoDiffuseOne) {
    RenderSettings with_layers = settings();
    with_layers.layers = {LayerKind::diffuse, LayerKind::specular};
    scene::Scene scene = make_box_scene(kSize);
    for (scene::Material& material : scene.materials) material.model = scene::BrdfModel::lambert;
    const RenderResult matte = render(scene, with_layers);
    for (const float value : data_of(matte, "specular")) ASSERT_EQ(value, 0);

    for (scene::Material& material : scene.materials) {
        material.model = scene::BrdfModel::frostbite;
        material.diffuse = {0, 0, 0};
        material.f0 = {0.9f, 0.8f, 0.7f};
        material.roughness = 0.5f;
    }
    const RenderResult metal = render(scene, with_layers);
    for (const float value : data_of(metal, "diffuse")) ASSERT_EQ(value, 0);
    EXPECT_GT(*std::max_element(data_of(metal, "specular").begin(), data_of(metal, "specular").end()), 0);
}

INSTANTIATE_TEST_SUITE_P(Estimates, Layers, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

std::vector<std::vector<double>> layer_means(const render_cpu::Renderer& renderer, RenderSettings settings,
                                             const std::string& name, int first_seed) {
    std::vector<std::vector<double>> rows;
    for (int seed = 0; seed < kSeeds; ++seed) {
        settings.seed = static_cast<std::uint32_t>(first_seed + seed);
        const RenderResult result = renderer.render(settings, base::choose_isa());
        rows.push_back(region_means({kSize, kSize, data_of(result, name)}, kRegionsPerAxis));
    }
    return rows;
}

/// The weights of samples must not shift light from one component to the other.
TEST(LayersStatistics, ComponentsDoNotDependOnTheHeuristic) {
    const scene::Scene scene = make_box_scene(kSize);
    const render_cpu::Renderer renderer(scene, 2);
    RenderSettings settings;
    settings.layers = {LayerKind::diffuse, LayerKind::specular};
    settings.samples = 4;
    settings.technique = Technique::area;
    const auto diffuse = layer_means(renderer, settings, "diffuse", 1000);
    const auto specular = layer_means(renderer, settings, "specular", 1000);
    settings.technique = Technique::projected_solid_angle;
    settings.strategies = Strategies::diffuse_ltc;
    for (const Mis mis : {Mis::balance, Mis::weighted_balance, Mis::clamped_optimal, Mis::optimal,
                          Mis::one_sample, Mis::separate}) {
        settings.mis = mis;
        EXPECT_LT(largest_t(layer_means(renderer, settings, "diffuse", 0), diffuse), kLargestT)
            << name_of(mis);
        EXPECT_LT(largest_t(layer_means(renderer, settings, "specular", 0), specular), kLargestT)
            << name_of(mis);
    }
    // The test of the test: another share of the diffuse component is noticed.
    scene::Scene darker = scene;
    for (float* channel : {&darker.materials[1].diffuse.x, &darker.materials[1].diffuse.y}) *channel *= 0.9f;
    const render_cpu::Renderer other(darker, 2);
    EXPECT_GT(largest_t(layer_means(other, settings, "diffuse", 0), diffuse), kLargestT);
}

/// The variance between seeds is what the layer estimates from the camera rays of one image.
TEST(LayersStatistics, VarianceIsThatBetweenSeeds) {
    constexpr int kManySeeds = 200;
    const scene::Scene scene = make_box_scene(kSize);
    const render_cpu::Renderer renderer(scene, 2);
    RenderSettings settings;
    settings.sample_order = render::SampleOrder::independent;
    settings.samples = 4;
    settings.layers = {LayerKind::variance};
    const std::size_t floats = 3 * kSize * kSize;
    std::vector<double> sum(floats), squares(floats), estimates(floats);
    for (int seed = 0; seed < kManySeeds; ++seed) {
        settings.seed = static_cast<std::uint32_t>(seed);
        const RenderResult result = renderer.render(settings, base::choose_isa());
        const std::vector<float>& variance = data_of(result, "variance");
        for (std::size_t i = 0; i < floats; ++i) {
            const double value = result.image.pixels[i];
            sum[i] += value;
            squares[i] += value * value;
            estimates[i] += variance[i] / double(kManySeeds);
        }
    }
    // Per channel: sums over pixels, so that a few noisy pixels do not decide, nor the many without noise.
    for (std::size_t channel = 0; channel < 3; ++channel) {
        double between = 0;
        double estimated = 0;
        for (std::size_t i = channel; i < floats; i += 3) {
            between += (squares[i] - sum[i] * sum[i] / kManySeeds) / (kManySeeds - 1);
            estimated += estimates[i];
        }
        EXPECT_NEAR(estimated / between, 1, 0.05) << channel;
    }
}

TEST(LayersOfHits, ShowTheFirstSurface) {
    scene::Scene scene = make_floor(kSize);
    // A view over the edge of the floor, so that the upper pixels are empty.
    set_camera(scene, {0.1f, -2.5f, 0.7f}, {0.1f, 1, 0.6f}, {0, 0, 1}, 0.5, kSize, kSize);
    add_line_light(scene, "tube", {0, {-1, 3, 2}, {1, 3, 2}, 0.3f, {1, 1, 1}, scene::TubeModel::solid});
    scene.materials[0].diffuse = {0.6f, 0.4f, 0.2f};
    set_radius(scene);
    RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.layers = {LayerKind::albedo, LayerKind::normal, LayerKind::depth};
    const RenderResult result = render(scene, settings);
    const std::vector<float>& albedo = data_of(result, "albedo");
    const std::vector<float>& normal = data_of(result, "normal");
    const std::vector<float>& depth = data_of(result, "depth");
    const std::vector<float>& coverage = data_of(result, "coverage");
    int on_floor = 0, on_tube = 0, empty = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const auto i = static_cast<std::size_t>(y * kSize + x);
            const scene::Camera& camera = scene.camera;
            const double direction[3] = {
                camera.corner.x + (x + 0.5) * camera.right.x + (y + 0.5) * camera.down.x,
                camera.corner.y + (x + 0.5) * camera.right.y + (y + 0.5) * camera.down.y,
                camera.corner.z + (x + 0.5) * camera.right.z + (y + 0.5) * camera.down.z};
            const double length = std::hypot(direction[0], direction[1], direction[2]);
            const double t = -camera.origin.z / direction[2];
            const double floor_y = camera.origin.y + t * direction[1];
            const double floor_x = camera.origin.x + t * direction[0];
            if (t > 0 && floor_y < 3.99 && std::fabs(floor_x) < 3.99) {
                ++on_floor;
                ASSERT_NEAR(depth[i], t * length, 1e-5 * t * length);
                ASSERT_EQ(coverage[i], 1);
                ASSERT_EQ(albedo[3 * i], 0.6f);
                ASSERT_EQ(albedo[3 * i + 2], 0.2f);
                ASSERT_NEAR(normal[3 * i], 0, 1e-6);
                ASSERT_NEAR(normal[3 * i + 2], 1, 1e-6);
            } else if (t < 0) {
                (coverage[i] == 1 ? on_tube : empty) += 1;
                // The tube is 5.5 m away, and 0.3 m thick.
                ASSERT_NEAR(depth[i], coverage[i] == 1 ? 5.5 : 0, coverage[i] == 1 ? 0.6 : 0);
                ASSERT_EQ(albedo[3 * i], 0);
                ASSERT_EQ(normal[3 * i + 2], 0);
            }
        }
    EXPECT_GT(on_floor, 300);
    EXPECT_GT(on_tube, 10);
    EXPECT_GT(empty, 100);
}

/// Pixels on the horizon see floor and nothing: depth is a mean over hits, albedo over all rays.
TEST(LayersOfHits, AreMeansOverCameraRays) {
    scene::Scene scene = make_floor(kSize);
    set_camera(scene, {0.1f, -2.5f, 0.7f}, {0.1f, 1, 0.6f}, {0, 0, 1}, 0.5, kSize, kSize);
    RenderSettings settings;
    settings.samples = 64;
    settings.layers = {LayerKind::albedo, LayerKind::depth};
    const RenderResult result = render(scene, settings);
    const std::vector<float>& coverage = data_of(result, "coverage");
    int mixed = 0;
    for (std::size_t i = 0; i < coverage.size(); ++i) {
        ASSERT_NEAR(data_of(result, "albedo")[3 * i], kFloorAlbedo * coverage[i], 1e-6);
        if (coverage[i] <= 0 || coverage[i] >= 1) continue;
        ++mixed;
        // The floor ends 6.5 m away from the camera.
        ASSERT_GT(data_of(result, "depth")[i], 5);
    }
    EXPECT_GT(mixed, 10);
}

TEST(LayersOfHits, OfACropAreThoseOfTheWholeImage) {
    scene::Scene scene = make_box_scene(kSize);
    RenderSettings settings;
    settings.samples = 2;
    settings.layers = kAllKinds;
    const RenderResult whole = render(scene, settings);
    const scene::PixelBounds crop{8, 4, 31, 27};
    scene.film.crop = crop;
    const RenderResult part = render(scene, settings);
    ASSERT_EQ(part.layers.size(), whole.layers.size());
    for (std::size_t i = 0; i < part.layers.size(); ++i) {
        const std::size_t channels = part.layers[i].channels.size();
        std::vector<float> expected;
        for (int y = crop.y_begin; y < crop.y_end; ++y) {
            const auto row = whole.layers[i].data.begin() + static_cast<std::ptrdiff_t>(channels) * kSize * y;
            expected.insert(expected.end(), row + static_cast<std::ptrdiff_t>(channels) * crop.x_begin,
                            row + static_cast<std::ptrdiff_t>(channels) * crop.x_end);
        }
        EXPECT_EQ(part.layers[i].data, expected) << part.layers[i].name;
    }
}

TEST(LayersOfHits, VarianceNeedsTwoCameraRays) {
    RenderSettings settings;
    settings.layers = {LayerKind::variance};
    EXPECT_TRUE(render(make_floor(8), settings).layers.empty());
}

TEST(LayersOfLights, HaveUniqueNames) {
    scene::Scene scene = make_box_scene(8);
    scene.emitters = {{"a lamp"}, {"a.lamp"}, {""}, {"polygon at some/folder/room.pbrt:7"}, {"a:lamp"}};
    RenderSettings settings;
    settings.layers = {LayerKind::lights};
    const RenderResult result = render(scene, settings);
    ASSERT_EQ(result.layers.size(), 5u);
    EXPECT_EQ(result.layers[0].name, "light.a_lamp");
    EXPECT_EQ(result.layers[1].name, "light.a_lamp.1");
    EXPECT_EQ(result.layers[2].name, "light.unnamed");
    EXPECT_EQ(result.layers[3].name, "light.polygon_at_room_pbrt_7");
    EXPECT_EQ(result.layers[4].name, "light.a_lamp.4");
}

TEST(Frames, LargerThanAnyFileAreRefused) {
    scene::Scene scene = make_floor(8);
    scene.film.width = scene.film.height = 65536;
    EXPECT_THROW(render::make_frame(scene, {}), std::runtime_error);
    scene.film.crop = scene::PixelBounds{60000, 65530, 60020, 65536};
    const render::Frame frame = render::make_frame(scene, {});
    EXPECT_EQ(frame.image.width, 20);
    EXPECT_EQ(frame.image.height, 6);
}

TEST(Frames, LargerThanTheMemoryAreRefused) {
    EXPECT_NO_THROW(render::check_memory(1000, "something", "use a smaller image"));
    try {
        render::check_memory(std::size_t(1) << 60, "an image", "use a smaller image");
        FAIL() << "a machine with that much memory?";
    } catch (const std::runtime_error& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.rfind("an image needs 1152921504.6 GB of memory", 0), 0u) << message;
        EXPECT_NE(message.find("; use a smaller image"), std::string::npos) << message;
    }
}

TEST(Frames, KnowTheirSizeBeforeTheyTakeMemory) {
    scene::Scene scene = make_floor(100);
    scene.emitters.assign(256, {"lamp"});
    RenderSettings settings;
    settings.layers = {LayerKind::depth, LayerKind::lights, LayerKind::diffuse};
    const render::FrameSize size = render::frame_size(scene, settings);
    const render::Frame frame = render::make_frame(scene, settings);
    EXPECT_EQ(size.width, 100);
    EXPECT_EQ(size.height, 100);
    EXPECT_EQ(size.layers, frame.layers.size());
    EXPECT_EQ(size.layers, 2u + 2u + 256u);
    std::size_t floats = frame.image.pixels.size();
    for (const image::Layer& layer : frame.layers) floats += layer.data.size();
    EXPECT_EQ(size.channels * 100 * 100, floats);
    EXPECT_GE(size.bytes, sizeof(float) * floats);
    EXPECT_LE(static_cast<double>(size.bytes), 1.2 * sizeof(float) * static_cast<double>(floats));
}

TEST(Frames, LayersThatNoMachineOrFileHoldsAreRefused) {
    const auto error = [](std::size_t lights, int width, int height) {
        scene::Scene scene = make_floor(8);
        scene.film.width = width;
        scene.film.height = height;
        scene.emitters.assign(lights, {"lamp"});
        RenderSettings settings;
        settings.layers = {LayerKind::lights};
        try {
            render::make_frame(scene, settings);
        } catch (const std::runtime_error& failure) {
            return std::string(failure.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(error(10000, 60000, 4000)
                  .rfind("an image of 60000 x 4000 pixels with 30003 channels needs 28803.8 GB of memory", 0),
              0u)
        << error(10000, 60000, 4000);
    EXPECT_EQ(
        error(3000, 65536, 1),
        "9003 channels of 65536 pixels along x exceed the 2 GiB that EXR files can hold per row and for "
        "the list of channels; use a lower --resolution or fewer --layers");
}

TEST(Frames, PartsDivideAllPixels) {
    const scene::Scene scene = make_floor(100);
    // There are 7 x 7 tiles.
    for (int count = 1; count <= 100; ++count) {
        std::vector<int> owners(100 * 100);
        std::size_t fewest = owners.size(), most = 0;
        for (int number = 1; number <= count; ++number) {
            RenderSettings settings;
            settings.part = {number, count};
            const render::Frame frame = render::make_frame(scene, settings);
            fewest = std::min(fewest, frame.tiles.size());
            most = std::max(most, frame.tiles.size());
            for (const render::Tile& tile : frame.tiles)
                for (int y = tile.y_begin; y < tile.y_end; ++y)
                    for (int x = tile.x_begin; x < tile.x_end; ++x)
                        ++owners[static_cast<std::size_t>(100 * y + x)];
        }
        EXPECT_EQ(std::count(owners.begin(), owners.end(), 1), 100 * 100) << count;
        EXPECT_LE(most - fewest, 1u) << count;
    }
}

} // namespace
} // namespace nusselt::render_test
