// Lights without extent: point, spot and distant lights, and images by direction. All settings render their closed forms.

#include "scenes.h"

#include "scene/model/bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::render_test {
namespace {

using render::LayerKind;
using scene::DistantLight;
using scene::Double3;
using scene::normalized;
using scene::PointDistribution;
using scene::PointLight;
using scene::to_float;

constexpr int kSize = 24;
constexpr double kPi = std::numbers::pi;

/// A floor from -2 to 2 in parallel projection from above, without lights.
scene::Scene make_lit_floor() {
    scene::Scene scene = make_floor(kSize);
    scene.camera = {.origin = {-2, 2, 5},
                    .origin_right = {4.0f / kSize, 0, 0},
                    .origin_down = {0, -4.0f / kSize, 0},
                    .corner = {0, 0, -1},
                    .right = {0, 0, 0},
                    .down = {0, 0, 0}};
    scene.radius = scene_radius(scene);
    return scene;
}

template <class Light>
scene::Scene with_light(scene::Scene scene, Light light) {
    light.emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({"lamp"});
    scene.lights.of<Light>().push_back(light);
    return scene;
}

render::RenderSettings centred() {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 2;
    return settings;
}

render::RenderResult render_floor(const scene::Scene& scene, const render::RenderSettings& settings,
                                  base::Isa isa = base::choose_isa()) {
    return render_cpu::Renderer(scene, 2).render(settings, isa);
}

Double3 floor_point(int x, int y) { return {-2 + 4 * (x + 0.5) / kSize, 2 - 4 * (y + 0.5) / kSize, 0}; }

/// The irradiance of a point of the floor, of each channel.
using Irradiance = std::function<Double3(const Double3& point)>;

/// How far the image is from the closed form, relative to the largest value.
double largest_error(const image::Image& image, const Irradiance& irradiance) {
    double largest = 0;
    double error = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const Double3 e = irradiance(floor_point(x, y));
            const double expected[] = {e.x, e.y, e.z};
            for (std::size_t k = 0; k < 3; ++k) {
                const double radiance = static_cast<double>(kFloorAlbedo) / kPi * expected[k];
                const auto pixel = static_cast<std::size_t>(y * kSize + x);
                largest = std::max(largest, radiance);
                error = std::max(error, std::fabs(image.pixels[3 * pixel + k] - radiance));
            }
        }
    return error / largest;
}

const Double3 kPlace = {0.3, -0.2, 1.5};

/// \param intensity in the direction away from the light, which need not be of unit length
Irradiance irradiance_of_point(const std::function<Double3(const Double3& away)>& intensity) {
    return [intensity](const Double3& point) {
        const Double3 away = point - kPlace;
        const double distance = length(away);
        return (kPlace.z / (distance * distance * distance)) * intensity(away);
    };
}

PointLight point_light() { return {.position = to_float(kPlace), .intensity = {1, 2, 3}}; }

/// Turned by 30 degrees about x: z of the light points down and aside.
void tilt(PointLight& light) {
    const double c = std::cos(kPi / 6), s = std::sin(kPi / 6);
    light.x_axis = {1, 0, 0};
    light.y_axis = to_float({0, -c, -s});
    light.z_axis = to_float({0, s, -c});
}

double degrees_from_axis(const PointLight& light, const Double3& away) {
    const Double3 axis = to_double(light.z_axis);
    return std::atan2(length(cross(axis, away)), dot(axis, away)) * 180 / kPi;
}

double cosine(double degrees) { return std::cos(degrees * kPi / 180); }

double cone_share(const PointLight& light, const Double3& away) {
    const double angle = degrees_from_axis(light, away);
    if (angle >= light.cone_angle) return 0;
    if (angle <= light.full_angle) return 1;
    const double t =
        (cosine(angle) - cosine(light.cone_angle)) / (cosine(light.full_angle) - cosine(light.cone_angle));
    return light.distribution == PointDistribution::smooth_cone ? 3 * t * t - 2 * t * t * t : std::pow(t, 4);
}

/// Texels in rows from below.
int add_image(scene::Scene& scene, int width, int height, std::vector<float> texels) {
    scene.textures.push_back({.name = "map",
                              .width = width,
                              .height = height,
                              .texels = std::move(texels),
                              .channels = 3,
                              .wrap = scene::TextureWrap::clamp,
                              .filter = scene::TextureFilter::nearest});
    return static_cast<int>(scene.textures.size()) - 1;
}

struct Case {
    std::string name;
    scene::Scene scene;
    Irradiance irradiance;
};

Case isotropic_case() {
    return {"isotropic", with_light(make_lit_floor(), point_light()), irradiance_of_point([](const Double3&) {
                return Double3{1, 2, 3};
            })};
}

Case cone_case(const std::string& name, PointDistribution distribution, float cone, float full) {
    PointLight light = point_light();
    light.distribution = distribution;
    light.cone_angle = cone;
    light.full_angle = full;
    tilt(light);
    return {name, with_light(make_lit_floor(), light), irradiance_of_point([light](const Double3& away) {
                return cone_share(light, away) * to_double(light.intensity);
            })};
}

Case distant_case() {
    const Double3 way = normalized({0.3, 0.5, -1});
    return {"distant",
            with_light(make_lit_floor(), DistantLight{.direction = to_float(way), .irradiance = {3, 2, 1}}),
            [way](const Double3&) {
                return -way.z * Double3{3, 2, 1};
            }};
}

/// The upper half of the picture is red, the lower one green; beyond it there is no light.
Case projection_case() {
    scene::Scene scene = make_lit_floor();
    PointLight light = point_light();
    light.distribution = PointDistribution::projected_image;
    light.texture = add_image(scene, 2, 2, {0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0, 0});
    light.half_extent = {0.6f, 0.4f};
    light.x_axis = {1, 0, 0};
    light.y_axis = {0, -1, 0};
    light.z_axis = {0, 0, -1};
    return {"projection", with_light(scene, light), irradiance_of_point([](const Double3& away) {
                const double x = away.x / -away.z, y = away.y / -away.z;
                if (std::fabs(x) > 0.6f || std::fabs(y) > 0.4f) return Double3{};
                return y > 0 ? Double3{1, 0, 0} : Double3{0, 2, 0};
            })};
}

/// Quarters of a sphere by latitude and longitude: the pole is x, azimuths begin at y.
Case latitude_case() {
    scene::Scene scene = make_lit_floor();
    PointLight light = point_light();
    light.distribution = PointDistribution::latitude_image;
    light.texture = add_image(scene, 2, 2, {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4});
    light.x_axis = {0, 1, 0};
    light.y_axis = {0, 0, -1};
    light.z_axis = {1, 0, 0};
    // What shines down has an azimuth below half a turn: the left column.
    return {"latitude", with_light(scene, light), irradiance_of_point([](const Double3& away) {
                return (away.x > 0 ? 3 : 1) * Double3{1, 2, 3};
            })};
}

/// Quarters of an octahedral map: those of x and y of the light, whatever z is.
Case octahedral_case() {
    scene::Scene scene = make_lit_floor();
    PointLight light = point_light();
    light.distribution = PointDistribution::octahedral_image;
    light.texture = add_image(scene, 2, 2, {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4});
    return {"octahedral", with_light(scene, light), irradiance_of_point([](const Double3& away) {
                // Rows are numbered from below, and v grows downwards.
                const int quarter = (away.x > 0 ? 1 : 0) + (away.y < 0 ? 2 : 0);
                return (1 + quarter) * Double3{1, 2, 3};
            })};
}

std::vector<Case> all_cases() {
    return {isotropic_case(),
            cone_case("spot", PointDistribution::smooth_cone, 50, 20),
            cone_case("spot of v3", PointDistribution::quartic_cone, 60, 10),
            cone_case("narrow spot", PointDistribution::smooth_cone, 4, 1),
            cone_case("wide spot", PointDistribution::smooth_cone, 120, 60),
            distant_case(),
            projection_case(),
            latitude_case(),
            octahedral_case()};
}

TEST(LightSources, RenderTheirClosedForms) {
    for (const Case& c : all_cases())
        for (const base::Isa isa : base::kAllIsas)
            if (is_supported(isa)) {
                const render::RenderResult result = render_floor(c.scene, centred(), isa);
                EXPECT_LT(largest_error(result.image, c.irradiance), 2e-4) << c.name;
                EXPECT_EQ(result.statistics.rejected_samples, 0u) << c.name;
            }
}

/// The tests of the test: what is wrong by half a per cent is noticed, and so is any other falloff.
TEST(LightSources, WithOtherFormsAreNoticed) {
    const image::Image image = render_floor(isotropic_case().scene, centred()).image;
    EXPECT_GT(largest_error(image, irradiance_of_point([](const Double3&) {
                                return 1.005 * Double3{1, 2, 3};
                            })),
              2e-4);
    const Case smooth = cone_case("", PointDistribution::smooth_cone, 50, 20);
    const Case quartic = cone_case("", PointDistribution::quartic_cone, 50, 20);
    EXPECT_GT(largest_error(render_floor(smooth.scene, centred()).image, quartic.irradiance), 0.02);
}

TEST(LightSources, DoNotDependOnSettings) {
    for (const Case& c : {isotropic_case(), distant_case()}) {
        const std::vector<float> expected = render_floor(c.scene, centred()).image.pixels;
        for (int technique = 0; technique < interface::kTechniqueCount; ++technique)
            for (int strategies = 0; strategies < interface::kStrategiesCount; ++strategies)
                for (const auto samples : {render::LightSamples::points, render::LightSamples::lines})
                    for (const int count : {1, 8}) {
                        render::RenderSettings settings = centred();
                        settings.technique = static_cast<render::Technique>(technique);
                        settings.strategies = static_cast<render::Strategies>(strategies);
                        settings.light_samples = samples;
                        settings.samples = count;
                        settings.seed = 5;
                        try {
                            validate(settings);
                        } catch (const std::invalid_argument&) {
                            continue;
                        }
                        const std::vector<float> found = render_floor(c.scene, settings).image.pixels;
                        ASSERT_EQ(found.size(), expected.size());
                        for (std::size_t i = 0; i < found.size(); ++i)
                            ASSERT_NEAR(found[i], expected[i], 2e-6 * expected[i])
                                << c.name << " " << technique << " " << strategies << " " << count;
                    }
    }
}

TEST(LightSources, TakeOneShadowRayWhateverTheNumberOfSamples) {
    for (const int count : {1, 16}) {
        render::RenderSettings settings = centred();
        settings.samples = count;
        settings.camera_rays = 1;
        EXPECT_EQ(render_floor(isotropic_case().scene, settings).statistics.shadow_rays,
                  static_cast<std::uint64_t>(kSize * kSize));
    }
    // What a spot leaves dark needs none.
    const Case narrow = cone_case("", PointDistribution::smooth_cone, 4, 1);
    EXPECT_LT(render_floor(narrow.scene, centred()).statistics.shadow_rays, 50u);
}

/// A screen of 1 m at a height of 0.75 m, over the middle of the floor.
scene::Scene with_screen(scene::Scene scene) {
    add_quad(scene,
             {Float3{-0.5f, -0.5f, 0.75f}, {0.5f, -0.5f, 0.75f}, {0.5f, 0.5f, 0.75f}, {-0.5f, 0.5f, 0.75f}},
             0);
    scene.radius = scene_radius(scene);
    return scene;
}

TEST(LightSources, CastShadows) {
    // The camera looks at the floor from below the screen.
    const auto shadow_of = [](const auto& light, const Double3& at) {
        scene::Scene scene = with_screen(with_light(make_lit_floor(), light));
        scene.camera.origin.z = 0.5f;
        const image::Image image = render_floor(scene, centred()).image;
        const int x = static_cast<int>((at.x + 2) * kSize / 4);
        const int y = static_cast<int>((2 - at.y) * kSize / 4);
        return image.pixels[static_cast<std::size_t>(3 * (y * kSize + x))] == 0;
    };
    const PointLight lamp{.position = {0, 0, 1.5f}, .intensity = {1, 1, 1}};
    EXPECT_TRUE(shadow_of(lamp, {0, 0, 0}));
    EXPECT_TRUE(shadow_of(lamp, {0.9, 0.9, 0}));
    EXPECT_FALSE(shadow_of(lamp, {1.1, 1.1, 0}));
    // Below the screen it casts no shadow.
    EXPECT_FALSE(shadow_of(PointLight{.position = {0, 0, 0.7f}, .intensity = {1, 1, 1}}, {0, 0, 0}));
    const DistantLight sun{.direction = to_float(normalized({1, 0, -0.75})), .irradiance = {1, 1, 1}};
    EXPECT_TRUE(shadow_of(sun, {0.6, 0, 0}));
    EXPECT_TRUE(shadow_of(sun, {1.4, 0.4, 0}));
    EXPECT_FALSE(shadow_of(sun, {0.4, 0, 0}));
    EXPECT_FALSE(shadow_of(sun, {1.6, 0, 0}));
}

/// Light from far away passes over a small scene in which everything that blocks it is far from the shading point.
TEST(LightSources, ShadowsOfDistantLightsReachThroughTheScene) {
    scene::Scene scene =
        with_light(make_lit_floor(), DistantLight{.direction = {0, 0, -1}, .irradiance = {1, 1, 1}});
    add_quad(scene, {Float3{-9, -9, 4000}, {9, -9, 4000}, {9, 9, 4000}, {-9, 9, 4000}}, 0);
    scene.radius = scene_radius(scene);
    for (const float value : render_floor(scene, centred()).image.pixels) ASSERT_EQ(value, 0);
}

TEST(LightSources, HaveLayers) {
    scene::Scene scene = isotropic_case().scene;
    scene.materials[0].model = scene::BrdfModel::frostbite;
    scene.materials[0].roughness = 0.4f;
    scene.camera.origin.z = 5;
    render::RenderSettings settings = centred();
    settings.layers = {LayerKind::diffuse, LayerKind::specular, LayerKind::lights};
    const render::RenderResult result = render_floor(scene, settings);
    const auto layer = [&](const std::string& name) -> const std::vector<float>& {
        for (const image::Layer& one : result.layers)
            if (one.name == name) return one.data;
        throw std::runtime_error("no layer " + name);
    };
    for (std::size_t i = 0; i < result.image.pixels.size(); ++i) {
        const float value = result.image.pixels[i];
        ASSERT_GT(layer("diffuse")[i], 0);
        ASSERT_NEAR(layer("diffuse")[i] + layer("specular")[i], value, 1e-6 * value);
        ASSERT_EQ(layer("light.lamp")[i], value);
    }
}

/// In the surface, next to it, below it, in all directions, as bright and as far away as scenes may have them.
TEST(LightSources, GiveFiniteImagesAtAnyPlace) {
    const Double3 pixel = floor_point(kSize / 2, kSize / 2);
    for (const float brightness : {1.0f, 1e30f})
        for (const float z : {0.0f, 1e-30f, 1e-12f, 1e-4f, -1.0f, -1e-12f, 1e15f})
            for (const int distribution : {0, 1, 2, 3, 4, 5}) {
                scene::Scene scene = make_lit_floor();
                PointLight light{.position = {static_cast<float>(pixel.x), static_cast<float>(pixel.y), z},
                                 .intensity = {brightness, 0, brightness},
                                 .distribution = static_cast<PointDistribution>(distribution),
                                 .cone_angle = 180,
                                 .full_angle = 180};
                if (is_image(light.distribution)) light.texture = add_image(scene, 1, 1, {1, 3e38f, 3e38f});
                const render::RenderResult result = render_floor(with_light(scene, light), centred());
                EXPECT_EQ(result.statistics.rejected_samples, 0u) << z;
                for (const float value : result.image.pixels) {
                    ASSERT_TRUE(std::isfinite(value) && value >= 0) << z << " " << distribution;
                    if (z < 0) {
                        ASSERT_EQ(value, 0);
                    }
                }
            }
    for (const Float3& way : {Float3{0, 0, 1}, Float3{1, 0, 0}, Float3{0, -1, 0}, Float3{1, 0, 1e-30f}}) {
        const scene::Scene scene =
            with_light(make_lit_floor(), DistantLight{.direction = way, .irradiance = {1e30f, 1, 1}});
        for (const float value : render_floor(scene, centred()).image.pixels) ASSERT_EQ(value, 0);
    }
}

TEST(LightSources, AreInvisibleAndDoNotCountForTheSizeOfTheScene) {
    scene::Scene scene = make_lit_floor();
    const double radius = scene_radius(scene);
    scene = with_light(scene, PointLight{.position = {0, 0, 1e9f}, .intensity = {1, 1, 1}});
    scene = with_light(scene, DistantLight{});
    EXPECT_EQ(scene_radius(scene), radius);
    scene.lights.of<PointLight>()[0].position = {0, 0, 1};
    scene.camera.origin.z = 0.5f;
    scene.camera.corner = {0, 0, 1};
    for (const float value : render_floor(scene, centred()).image.pixels) ASSERT_EQ(value, 0);
}

} // namespace
} // namespace nusselt::render_test
