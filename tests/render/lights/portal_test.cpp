// Portals of environments: what comes through them on a floor and to cameras, whichever way it is sampled.

#include "lights/sky_scenes.h"
#include "scenes.h"

#include "scene/model/vector_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

namespace nusselt::render_test {
namespace {

using scene::Double3;
using scene::EnvironmentLight;
using scene::EnvironmentMapTexels;

/// Columns and rows of maps: small ones where what they show does not matter.
constexpr int kSmall = 32;
constexpr int kPrecise = 128;
constexpr Double3 kToSun = {0.36, 0.48, 0.8};

/// Shapes in the plane z = 1 above the floor.
const scene::PolygonVertices kRectangle = {{0, -0.4f, 1}, {0.8f, -0.4f, 1}, {0.8f, 0.9f, 1}, {0, 0.9f, 1}};
const scene::PolygonVertices kPentagon = {
    {0.1f, -0.3f, 1}, {0.7f, -0.4f, 1}, {1, 0.3f, 1}, {0.4f, 1, 1}, {-0.1f, 0.5f, 1}};
/// Through this one, the map varies so little that samples know nothing of it.
const scene::PolygonVertices kAwayFromSun = {
    {-0.2f, -0.5f, 1}, {0.1f, -0.5f, 1}, {0.1f, -0.3f, 1}, {-0.2f, -0.3f, 1}};

/// The radiance of the map as a function. The map itself is interpolated between texels.
double radiance_towards(const Double3& d) {
    return 0.3 + 0.2 * d.x + 0.1 * d.z + 20 * std::exp(90 * (dot(d, kToSun) - 1));
}

EnvironmentMapTexels make_map(int size) {
    return make_sky_map(size, [](const Double3& d) {
        const auto l = static_cast<float>(radiance_towards(d));
        return Float3{2 * l, l, l};
    });
}

/// A floor, all pixels of which show its point at the origin, below a portal. \param map_size 0 for the same radiance everywhere
scene::Scene make_scene(const scene::PolygonVertices& portal, int map_size) {
    scene::Scene scene = make_floor(kSkyPixels);
    set_camera(scene, {-0.2f, -0.3f, 0.6f}, {0, 0, 0}, {0, 1, 0}, 1e-4, kSkyPixels, kSkyPixels);
    const EnvironmentLight light{.radiance = {2, 1, 1}, .portal = portal};
    if (map_size == 0) {
        add_sky(scene, light);
    } else {
        const EnvironmentMapTexels map = make_map(map_size);
        add_sky(scene, light, &map);
    }
    return scene;
}

/// What the origin reflects of light that passes a horizontal polygon at a height of one: the midpoint rule over its area.
template <class Radiance>
double reflected(const scene::PolygonVertices& portal, const Radiance& radiance) {
    // Sides of the rectangle are lines of the grid.
    constexpr double kStep = 0.0025;
    double sum = 0;
    for (int j = 0; j < 640; ++j) {
        for (int i = 0; i < 480; ++i) {
            const Double3 p = {-0.2 + kStep * (i + 0.5), -0.5 + kStep * (j + 0.5), 1};
            bool is_inside = true;
            for (std::size_t k = 0; k < portal.size(); ++k) {
                const Float3& a = portal[k];
                const Float3& b = portal[(k + 1) % portal.size()];
                is_inside = is_inside && (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0;
            }
            const double squared = dot(p, p);
            if (is_inside) sum += kStep * kStep * radiance(normalized(p)) / (squared * squared);
        }
    }
    return kFloorAlbedo / std::numbers::pi * sum;
}

scene::PolygonVertices reversed(const scene::PolygonVertices& portal) {
    std::vector<Float3> vertices(portal.begin(), portal.end());
    std::reverse(vertices.begin(), vertices.end());
    return vertices;
}

scene::PolygonVertices with_side_moved(scene::PolygonVertices portal, float distance) {
    for (Float3& vertex : portal) vertex.y += vertex.y < 0 ? distance : 0;
    return portal;
}

TEST(UniformPortal, LightsAFloorWithoutNoise) {
    for (const scene::PolygonVertices& portal : {kRectangle, kPentagon}) {
        const double expected = reflected(portal, [](const Double3&) { return 1.0; });
        for (const auto& vertices : {portal, reversed(portal)}) {
            for (const auto technique :
                 {render::Technique::projected_solid_angle, render::Technique::ltc_analytic}) {
                render::RenderSettings settings = centred(1);
                settings.technique = technique;
                const PixelMean mean = render_green(make_scene(vertices, 0), settings);
                EXPECT_NEAR(mean.value, expected, 2e-3 * expected);
                EXPECT_LT(mean.deviation, 1e-4 * expected);
            }
        }
    }
}

TEST(PortalWithMap, ThatVariesLittleIsSampledByTheMeasure) {
    const auto value = [](const scene::PolygonVertices& portal, render::EmissionSampling sampling) {
        render::RenderSettings settings = centred(2);
        settings.emission_sampling = sampling;
        return render_green(make_scene(portal, kSmall), settings).value;
    };
    using render::EmissionSampling;
    EXPECT_EQ(value(kAwayFromSun, EmissionSampling::product), value(kAwayFromSun, EmissionSampling::measure));
    EXPECT_NE(value(kRectangle, EmissionSampling::product), value(kRectangle, EmissionSampling::measure));
}

TEST(PortalWithMap, LightsAFloorLikeQuadrature) {
    for (const scene::PolygonVertices& portal : {kRectangle, kPentagon, kAwayFromSun}) {
        const double expected = reflected(portal, radiance_towards);
        for (const auto& vertices : {portal, reversed(portal)}) {
            const PixelMean mean = render_green(make_scene(vertices, kPrecise), centred(64));
            // Interpolation flattens the sun a little.
            const double tolerance = 5e-3 * expected;
            EXPECT_NEAR(mean.value, expected, 5 * mean.error + tolerance);
            std::printf("noise of one sample: %.3f\n", 8 * mean.deviation / expected);
            EXPECT_LT(8 * mean.deviation, 0.2 * expected);
            // The test of the test: one side of the portal is 8 cm off.
            const PixelMean wrong =
                render_green(make_scene(with_side_moved(vertices, 0.08f), kPrecise), centred(64));
            EXPECT_GT(std::fabs(wrong.value - expected), 5 * wrong.error + tolerance);
        }
    }
}

/// The integrals of cells, with their mean radiance.
TEST(PortalWithMap, AnalyticShadingHasNoNoise) {
    const double expected = reflected(kRectangle, radiance_towards);
    render::RenderSettings settings = centred(1);
    settings.technique = render::Technique::ltc_analytic;
    const PixelMean mean = render_green(make_scene(kRectangle, kPrecise), settings);
    EXPECT_NEAR(mean.value, expected, 0.04 * expected);
    EXPECT_LT(mean.deviation, 1e-4 * expected);
}

/// The same light as without a portal, if there is a wall with a hole. There, the noise is that of shadows.
TEST(PortalWithMap, IsAWallWithAHole) {
    const auto with_wall = [&](const scene::PolygonVertices& portal) {
        scene::Scene scene = make_scene(portal, kSmall);
        const auto add = [&](float x0, float y0, float x1, float y1) {
            add_quad(scene, {Float3{x0, y0, 1}, Float3{x1, y0, 1}, Float3{x1, y1, 1}, Float3{x0, y1, 1}}, 0);
        };
        add(-40, -40, 0, 40);
        add(0.8f, -40, 40, 40);
        add(0, -40, 0.8f, -0.4f);
        add(0, 0.9f, 0.8f, 40);
        set_radius(scene);
        return scene;
    };
    const PixelMean with = render_green(with_wall(kRectangle), centred(64));
    const PixelMean without = render_green(with_wall({}), centred(1024));
    EXPECT_NEAR(with.value, without.value, 5 * std::hypot(with.error, without.error));
    // Per sample: there are 16 times as many of them without a portal.
    const double gain = 4 * without.deviation / with.deviation;
    std::printf("noise without a portal over noise with it: %.1f\n", gain);
    EXPECT_GT(gain, 4);
    // The test of the test: a portal that is 3 % too narrow.
    scene::PolygonVertices narrow = kRectangle;
    narrow[1].x = narrow[2].x = 0.776f;
    const PixelMean wrong = render_green(with_wall(narrow), centred(64));
    EXPECT_GT(std::fabs(wrong.value - without.value), 5 * std::hypot(wrong.error, without.error));
    // What is between the floor and the portal, and what is beyond it, makes shadows.
    for (const float height : {0.5f, 5.0f}) {
        scene::Scene scene = make_scene(kRectangle, kSmall);
        add_quad(scene,
                 {Float3{-9, -9, height}, Float3{9, -9, height}, Float3{9, 9, height}, Float3{-9, 9, height}},
                 0);
        set_camera(scene, {-0.02f, -0.03f, 0.06f}, {0, 0, 0}, {0, 1, 0}, 1e-4, kSkyPixels, kSkyPixels);
        set_radius(scene);
        EXPECT_EQ(render_green(scene, centred(1)).value, 0);
    }
}

void make_glossy(scene::Scene& scene) {
    scene.materials[0].model = scene::BrdfModel::frostbite;
    scene.materials[0].f0 = {0.2f, 0.2f, 0.2f};
    scene.materials[0].roughness = 0.5f;
}

/// All strategies on a glossy floor agree with samples by the cosine, which know no lobe.
TEST(PortalWithMap, AllStrategiesHaveTheSameExpectation) {
    for (const int map_size : {0, kSmall}) {
        scene::Scene scene = make_scene(kRectangle, map_size);
        make_glossy(scene);
        const PixelMean reference = render_green(scene, centred(512));
        render::RenderSettings settings = centred(64);
        settings.strategies = render::Strategies::diffuse_ltc;
        for (const auto mis : render::kMisHeuristics) {
            settings.mis = mis;
            EXPECT_TRUE(agree(render_green(scene, settings), reference))
                << render::name_of(mis) << ", map: " << map_size;
        }
        // The test of the test: a tenth of the light is missing.
        scene.lights.of<EnvironmentLight>()[0].radiance.y *= 0.9f;
        EXPECT_FALSE(agree(render_green(scene, settings), reference));
    }
}

/// Samples of the polygon, whatever is behind it, like quadrature.
TEST(PortalByMeasure, LightsAFloorLikeQuadrature) {
    using render::Technique;
    for (const scene::PolygonVertices& portal : {kRectangle, kPentagon}) {
        const double expected = reflected(portal, radiance_towards);
        const scene::Scene scene = make_scene(portal, kPrecise);
        render::RenderSettings settings = centred(64);
        settings.emission_sampling = render::EmissionSampling::measure;
        const auto agrees = [&](const PixelMean& mean, double value) {
            return std::fabs(mean.value - value) <= 5 * mean.error + 5e-3 * value;
        };
        // Tests of the test: a cosine too many, and no portal.
        const double wrong = reflected(portal, [](const Double3& d) { return d.z * radiance_towards(d); });
        EXPECT_FALSE(agrees(render_green(make_scene({}, kPrecise), settings), expected));
        for (const auto technique : {Technique::area, Technique::solid_angle, Technique::clipped_solid_angle,
                                     Technique::projected_solid_angle}) {
            settings.technique = technique;
            const PixelMean mean = render_green(scene, settings);
            EXPECT_TRUE(agrees(mean, expected)) << render::name_of(technique);
            EXPECT_FALSE(agrees(mean, wrong)) << render::name_of(technique);
        }
    }
}

TEST(PortalByMeasure, AllStrategiesHaveTheExpectationOfProducts) {
    using render::Strategies;
    scene::Scene scene = make_scene(kPentagon, kSmall);
    make_glossy(scene);
    const PixelMean reference = render_green(scene, centred(512));
    render::RenderSettings settings = centred(128);
    settings.emission_sampling = render::EmissionSampling::measure;
    for (const auto strategies : {Strategies::diffuse_ltc, Strategies::diffuse_ggx}) {
        settings.strategies = strategies;
        settings.mis =
            strategies == Strategies::diffuse_ltc ? render::Mis::clamped_optimal : render::Mis::balance;
        settings.technique = render::Technique::projected_solid_angle;
        EXPECT_TRUE(agree(render_green(scene, settings), reference)) << render::name_of(strategies);
    }
    settings.technique = render::Technique::solid_angle;
    EXPECT_TRUE(agree(render_green(scene, settings), reference));
    // The test of the test: the mean radiance in place of the map.
    scene.lights.of<EnvironmentLight>()[0].map = -1;
    EXPECT_FALSE(agree(render_green(scene, settings), reference));
}

/// Where the outline cuts texels, products lose a part of their density, which the optimal heuristic would not forgive: here,
/// cells would have an error of 9 %.
TEST(PortalWithMap, TheOptimalHeuristicIsUnbiasedAtTheOutline) {
    const Double3 to_corner = scene::normalized({-0.1, 0.5, 1});
    const EnvironmentMapTexels map = make_sky_map(16, [&](const Double3& d) {
        const auto l = static_cast<float>(0.1 + 20 * std::exp(100 * (dot(d, to_corner) - 1)));
        return Float3{l, l, l};
    });
    scene::Scene scene = make_scene({}, 0);
    scene.lights.of<EnvironmentLight>().clear();
    add_sky(scene, {.portal = kPentagon}, &map);
    make_glossy(scene);
    const PixelMean reference = render_green(scene, centred(256));
    render::RenderSettings settings = centred(256);
    settings.strategies = render::Strategies::diffuse_ltc;
    settings.mis = render::Mis::optimal;
    const PixelMean mean = render_green(scene, settings);
    EXPECT_TRUE(agree(mean, reference)) << mean.value << ", expected " << reference.value;
    // The test of the test: an error of 4 %.
    EXPECT_FALSE(agree({1.04 * mean.value, mean.error, mean.deviation}, reference));
}

/// Products are worth their time where what is behind the portal varies.
TEST(PortalWithMap, ProductsHaveLessNoise) {
    const scene::Scene scene = make_scene(kRectangle, kSmall);
    render::RenderSettings settings = centred(4);
    const double product = render_green(scene, settings).deviation;
    settings.emission_sampling = render::EmissionSampling::measure;
    EXPECT_LT(product, 0.25 * render_green(scene, settings).deviation);
}

/// All light comes from one texel of a map with more texels than the table of the portal.
TEST(PortalWithMap, TexelsOfLargeMapsAreNotMissed) {
    constexpr std::size_t kLarge = 2048;
    constexpr std::size_t kColumn = 1331, kRow = 1250;
    EnvironmentMapTexels map{"map", kLarge, std::vector<Float3>(kLarge * kLarge, Float3{0, 0, 0}), {}};
    map.texels[kRow * kLarge + kColumn] = {1e6f, 1e6f, 1e6f};
    constexpr float kMean = 1e6f / (kLarge * kLarge);
    map.mean = {kMean, kMean, kMean};
    scene::Scene scene = make_scene(kRectangle, kSmall);
    scene.environment_maps[0] = std::make_shared<const EnvironmentMapTexels>(std::move(map));
    scene.lights.of<EnvironmentLight>()[0].radiance = {kMean, kMean, kMean};
    const PixelMean mean = render_green(scene, centred(64));
    const Double3 d = square_direction((kColumn + 0.5) / kLarge, (kRow + 0.5) / kLarge);
    const double expected = 4 * kFloorAlbedo * kMean * d.z;
    EXPECT_NEAR(mean.value, expected, 5 * mean.error + 1e-3 * expected);
    EXPECT_LT(mean.error, 0.02 * expected);
}

TEST(PortalWithMap, CamerasSeeTheSkyThroughIt) {
    struct View {
        Float3 eye, target;
        bool is_lit;
    };
    // Through the portal from below and from above, beside it, away from it, along its plane, and within this plane.
    const View views[] = {
        {{0, 0, 0.5f}, {0.2f, 0.3f, 1}, true},       {{0.3f, 0.2f, 2}, {0.1f, 0.4f, 1}, true},
        {{0, 0, 0.5f}, {-0.1f, 0.3f, 1}, false},     {{0.2f, 0.2f, 1.5f}, {0.2f, 0.3f, 2}, false},
        {{-9, 0.2f, 1.5f}, {-8, 0.2f, 1.5f}, false}, {{-9, 0.2f, 0.5f}, {-8, 0.2f, 0.5f}, false},
        {{-9, 0.2f, 1}, {-8, 0.2f, 1}, false}};
    for (const int map_size : {0, kPrecise}) {
        scene::Scene scene = make_scene(kRectangle, map_size);
        // Only what cameras see behind everything.
        scene.triangles.clear();
        scene.triangle_material.clear();
        scene.triangle_light.clear();
        scene.objects.clear();
        scene.instances.clear();
        for (const View& view : views) {
            set_camera(scene, view.eye, view.target, {0.1f, 1, 0.2f}, 1e-4, 1, 1);
            render::RenderSettings settings = centred(1);
            settings.layers = {render::LayerKind::lights};
            const auto result = render_cpu::Renderer(scene, 1).render(settings, base::choose_isa());
            const Double3 d = normalized(to_double(view.target) - to_double(view.eye));
            const double expected = !view.is_lit ? 0 : map_size > 0 ? radiance_towards(d) : 1;
            EXPECT_NEAR(result.image.pixels[1], expected, 0.02 * expected) << view.eye.z << " " << map_size;
            ASSERT_EQ(result.layers.size(), 1u);
            EXPECT_FLOAT_EQ(result.layers[0].data[1], result.image.pixels[1]);
        }
    }
}

/// No surface can be lit from points in the plane of the portal, or by a portal that is a needle.
TEST(PortalWithMap, HostilePortalsGiveFiniteImages) {
    const scene::PolygonVertices portals[] = {
        {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
        {{-1e9f, -1e9f, 1}, {1e9f, -1e9f, 1}, {1e9f, 1e9f, 1}, {-1e9f, 1e9f, 1}},
        {{0, 0, 1}, {1e-4f, 0, 1}, {1e-4f, 1e-4f, 1}, {0, 1e-4f, 1}},
        {{0, 0, 1}, {3, 0, 1}, {3, 1e-6f, 1}, {0, 1e-6f, 1}},
        {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}},
        {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}}};
    for (const auto& portal : portals) {
        for (const auto strategies : {render::Strategies::diffuse, render::Strategies::diffuse_ltc}) {
            render::RenderSettings settings = centred(2);
            settings.strategies = strategies;
            const PixelMean mean = render_green(make_scene(portal, kSmall), settings);
            EXPECT_TRUE(std::isfinite(mean.value) && mean.value >= 0);
        }
    }
    // Next to all of the hemisphere.
    const PixelMean open = render_green(make_scene(portals[1], 0), centred(4));
    EXPECT_NEAR(open.value, kFloorAlbedo, 1e-4);
}

} // namespace
} // namespace nusselt::render_test
