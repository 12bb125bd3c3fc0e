/// Lights with an IES profile or a spread, from files to pixels: the intensity in the far field, the flux, what cameras see, and
/// that all ways to sample them have one expectation.

#include "lights/far_field.h"
#include "lossy_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

namespace nusselt::render_test {
namespace {

/// A square at the height of 50 sizes that shines down, with the half-plane of 0 degrees along +y.
const std::string kSquare = "Shape \"trianglemesh\" \"point3 P\" [ -0.35 -0.35 35  -0.35 0.35 35  "
                            "0.35 0.35 35  0.35 -0.35 35 ] \"integer indices\" [ 0 1 2  0 2 3 ]\n";
/// A closed box around the middle of that square, whose first face is its lower side.
const std::string kBox =
    "Shape \"trianglemesh\" \"point3 P\" [ -0.35 -0.35 34.8  -0.35 0.35 34.8  "
    "0.35 0.35 34.8  0.35 -0.35 34.8  -0.35 -0.35 35.2  -0.35 0.35 35.2  0.35 0.35 35.2  "
    "0.35 -0.35 35.2 ] \"integer indices\" [ 0 1 2  0 2 3  4 6 5  4 7 6  0 5 1  0 4 5  "
    "1 6 2  1 5 6  2 7 3  2 6 7  3 4 0  3 7 4 ]\n";
const std::string kPoint = "Translate 0 0 35 Rotate 180 1 1 0 "
                           "LightSource \"point\" \"string ies\" \"lamp.ies\"\n";

scene::Scene load_square(const Case& lamp) { return load(lamp, kEmission + '\n' + kSquare); }

/// The integral of an intensity times a weight of the cosine over all directions.
double integral(const scene::test::Intensity& intensity, const std::function<double(double)>& weight) {
    constexpr int kRows = 1000, kColumns = 60;
    double sum = 0;
    for (int i = 0; i < kRows; ++i) {
        const double z = -1 + (i + 0.5) * 2 / kRows;
        const double radius = std::sqrt(1 - z * z);
        for (int j = 0; j < kColumns; ++j) {
            const double azimuth = 2 * kPi * (j + 0.5) / kColumns;
            sum += weight(z) * intensity({radius * std::cos(azimuth), radius * std::sin(azimuth), z});
        }
    }
    return sum * 4 * kPi / (kRows * kColumns);
}

TEST(ProfiledLight, FarFieldAndFluxOfSquaresAreThoseOfTheFile) {
    const std::vector<Case> lamps = scene::test::cases();
    ASSERT_GE(lamps.size(), 20u);
    std::size_t rejected_mirrored = 0, rejected_bright = 0;
    for (const Case& lamp : lamps) {
        const scene::Scene scene = load_square(lamp);
        const double emitted = integral(
            lamp.intensity, [](double z) { return std::clamp(z / scene::kGrazingCosine, 0.0, 1.0); });
        if (emitted == 0) {
            EXPECT_EQ(flux_of(scene), 0) << lamp.name;
            continue;
        }
        EXPECT_NEAR(flux_of(scene) / emitted, 1, 0.005) << lamp.name;
        const image::Image floor = render_floor(scene);
        const FarField far = far_field_of(scene.camera, floor, table_of(scene));
        EXPECT_LT(far.error, FarField::kLimit) << lamp.name;
        // The tests of the test.
        rejected_mirrored += far.rejects_mirrored ? 1 : 0;
        rejected_bright += far.rejects_bright ? 1 : 0;
    }
    EXPECT_EQ(rejected_mirrored, 7u);
    EXPECT_EQ(rejected_bright, lamps.size() - 1);
}

TEST(ProfiledLight, PointsHaveTheIntensitiesOfTheFile) {
    for (const Case& lamp : scene::test::cases()) {
        const scene::Scene scene = load(lamp, kPoint);
        const scene::PointLight& light = scene.lights.of<scene::PointLight>()[0];
        const double flux =
            scene::kLumensPerWatt * double{light.intensity.y} * double{light.image_integral.y};
        EXPECT_NEAR(flux / *lamp.flux, 1, lamp.name == "hemisphere, 1991" ? 1e-6 : 0.005) << lamp.name;
        const double peak = scene.luminaires.at(0)->profile.peak().candelas;
        EXPECT_LT(far_field_error(scene, lamp.intensity, peak), 0.01) << lamp.name;
    }
}

TEST(ProfiledLight, BoxesEmitAllOfTheFlux) {
    for (const Case& lamp : scene::test::cases()) {
        if (lamp.name != "sphere, 1986" && lamp.name != "direct and indirect, 2019" &&
            lamp.name != "askew, 2002")
            continue;
        const scene::Scene scene = load(lamp, kEmission + '\n' + kBox);
        ASSERT_EQ(scene.lights.of<scene::PolygonLight>().size(), 6u);
        EXPECT_NEAR(flux_of(scene) / *lamp.flux, 1, 0.005) << lamp.name;
        EXPECT_TRUE(scene.warnings.empty());
        const scene::IntensityProfile& table = table_of(scene);
        const auto intensity = [&](const Double3& w) { return table.intensity(w); };
        EXPECT_LT(far_field_error(scene, intensity, table.peak().candelas), 0.01) << lamp.name;
        // Both sides of a square also emit what goes up, but for what the grazing cosine takes from a sphere.
        const scene::Scene sides = load(lamp, kEmission + " \"bool twosided\" true\n" + kSquare);
        EXPECT_NEAR(flux_of(sides) / *lamp.flux, lamp.name == "sphere, 1986" ? 0.99 : 1, 0.005);
        EXPECT_LT(far_field_error(sides, intensity, table.peak().candelas), 0.01) << lamp.name;
    }
}

TEST(ProfiledLight, CamerasSeeTheRadiance) {
    const Case lamp = scene::test::cases().at(11);
    scene::Scene scene = load_square(lamp);
    for (const double angle : {0.0, 25.0, 50.0}) {
        const Double3 w{std::sin(angle * kDegree) * 0.6, std::sin(angle * kDegree) * 0.8,
                        -std::cos(angle * kDegree)};
        const Double3 eye = Double3{0.1, 0, kHeight} + 5.0 * w;
        set_camera(scene, to_float(eye), {0.1f, 0, static_cast<float>(kHeight)}, {0, 1, 0}, 1e-4, 1, 1);
        render::RenderSettings settings;
        settings.samples = 1;
        const image::Image image = render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
        const double expected = lamp.intensity(in_profile(w)) /
                                (scene::kLumensPerWatt * kSide * kSide * std::cos(angle * kDegree));
        EXPECT_NEAR(double{image.pixels[1]} / expected, 1, 0.01) << angle;
    }
}

/// Gives the last polygon of a scene a profile.
void set_profile(scene::Scene& scene, double spread, double angle) {
    const base::TemporaryFolder folder;
    const auto profile =
        scene::make_profile(scene::read_ies(write(scene::test::cases().at(11), folder.path())));
    const auto luminaire =
        std::make_shared<const scene::Luminaire>(scene::Luminaire{"lamp", "lamp", profile});
    scene::PolygonLight& light = scene.lights.of<scene::PolygonLight>().back();
    const auto shape = scene::profile_shape(std::span(&light, 1), 0, {luminaire, spread, angle});
    scene.emission_profiles = shape->emissions;
    light.profile = 0;
}

TEST(ProfiledLight, AllWaysToSampleHaveTheSameExpectation) {
    constexpr int kSize = 16;
    const auto make = [&](double angle) {
        scene::Scene scene = make_box_scene(kSize);
        set_profile(scene, 120, angle);
        return scene;
    };
    const scene::Scene scene = make(30);
    const render_cpu::Renderer renderer(scene, 2);
    const auto tracer = renderer.visibility().tracer();
    render::RenderSettings settings;
    settings.camera_rays = 1;
    settings.pixel_position = render::PixelPosition::center;
    settings.technique = render::Technique::area;
    settings.samples = 64;
    const auto rows = [&](const render_cpu::Renderer& r, const visibility::RayTracer& t) {
        return render_region_means(r, settings, kSeeds, t);
    };
    const auto reference = rows(renderer, tracer);
    settings.samples = 16;
    settings.technique = render::Technique::projected_solid_angle;
    EXPECT_LT(largest_t(rows(renderer, tracer), reference), kLargestT);
    settings.strategies = render::Strategies::diffuse_ltc;
    for (const auto mis : render::kMisHeuristics) {
        settings.mis = mis;
        EXPECT_LT(largest_t(rows(renderer, tracer), reference), kLargestT) << render::name_of(mis);
    }
    const LossyTracer mutant(tracer, 0.03);
    EXPECT_GT(largest_t(rows(renderer, mutant.tracer()), reference), kLargestT);
    const scene::Scene turned_scene = make(40);
    const render_cpu::Renderer turned(turned_scene, 2);
    EXPECT_GT(largest_t(rows(turned, turned.visibility().tracer()), reference), kLargestT);
}

/// A point of the floor below the middle of a panel of 2 x 2 m at a height of 1 m, with a radiance of 1.
scene::Scene make_spread_scene(const scene::ProfileRequest& request, bool two_sided) {
    scene::Scene scene = make_floor(8);
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add_polygon_light(scene, {Float3{-1, -1, 1}, Float3{-1, 1, 1}, Float3{1, 1, 1}, Float3{1, -1, 1}},
                      {1, 1, 1}, two_sided, 1);
    scene::PolygonLight& light = scene.lights.of<scene::PolygonLight>().back();
    const auto shape = scene::profile_shape(std::span(&light, 1), 0, request);
    scene.emission_profiles = shape->emissions;
    light.profile = 0;
    set_camera(scene, {0, -0.1f, 0.9f}, {0, 0, 0}, {0, 1, 0}, 1e-3, 4, 4);
    return scene;
}

/// What the point receives: the integral of 1 - s / t over the disc of slopes, over the share of the flux.
double spread_irradiance(double spread) {
    const double t = std::tan(0.5 * spread * kDegree);
    constexpr int kSteps = 20000;
    double sum = 0, flux = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double s = t * (i + 0.5) / kSteps;
        // A disc of radius 1 around the foot would be wholly on the panel.
        const double weight = (1 - s / t) * 2 * kPi * s / ((1 + s * s) * (1 + s * s)) * t / kSteps;
        flux += weight;
        if (s < 1) sum += weight;
    }
    return sum / (flux / kPi);
}

/// The same for a honeycomb that lies along the sides of the panel, with the slopes s of its holes along x and t along y.
/// \param place of the point along x, from the middle
double honeycomb_irradiance(double s, double t, double place) {
    constexpr int kSteps = 600;
    const double width = std::atan(s), height = std::atan(t);
    double sum = 0, flux = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double p = std::tan(width * ((i + 0.5) / (kSteps / 2) - 1));
        for (int k = 0; k < kSteps; ++k) {
            const double q = std::tan(height * (k + 0.5) / kSteps);
            const double squared = 1 + p * p + q * q;
            const double weight = (1 - std::fabs(p) / s) * (1 - q / t) * (1 + p * p) * (1 + q * q) /
                                  (squared * squared) * 4 * width * height / (double{kSteps} * kSteps);
            flux += weight;
            if (std::fabs(place + p) < 1 && q < 1) sum += weight;
        }
    }
    return sum / (flux / kPi);
}

struct MeanAndDeviation {
    double mean, deviation;
};

/// Of single samples.
MeanAndDeviation sample_floor(const scene::Scene& scene) {
    const render_cpu::Renderer renderer(scene, 1);
    render::RenderSettings settings;
    settings.samples = 1;
    settings.camera_rays = 1;
    settings.sample_order = render::SampleOrder::independent;
    double sum = 0, squares = 0;
    constexpr int kRuns = 64;
    for (int seed = 0; seed < kRuns; ++seed) {
        settings.seed = static_cast<std::uint32_t>(seed);
        const image::Image image = renderer.render(settings, base::choose_isa()).image;
        for (int i = 0; i < 16; ++i) {
            const double value = double{image.pixels[static_cast<std::size_t>(3 * i)]};
            sum += value;
            squares += value * value;
        }
    }
    constexpr double kCount = 16 * kRuns;
    const double mean = sum / kCount;
    return {mean, std::sqrt(std::max(squares / kCount - mean * mean, 0.0))};
}

TEST(ProfiledLight, SpreadKeepsThePowerAndAddsLittleNoise) {
    for (const double spread : {1.0, 5.0, 20.0, 60.0}) {
        for (const bool two_sided : {false, true}) {
            const auto [mean, deviation] = sample_floor(make_spread_scene({nullptr, spread, 0}, two_sided));
            const double expected = double{kFloorAlbedo} / kPi * spread_irradiance(spread);
            EXPECT_NEAR(mean / expected, 1, 0.01) << spread;
            EXPECT_LT(deviation, 0.08 * mean) << spread;
        }
    }
}

TEST(ProfiledLight, HoneycombsKeepThePowerAndAddLittleNoise) {
    const auto sample = [](double along, double across, double angle, double place) {
        scene::Scene scene =
            make_spread_scene({nullptr, scene::kWidestSpread, angle, {along, across}}, false);
        const auto x = static_cast<float>(place);
        set_camera(scene, {x, -0.1f, 0.9f}, {x, 0, 0}, {0, 1, 0}, 1e-3, 4, 4);
        return sample_floor(scene);
    };
    const auto slope = [](double angle) { return std::min(std::tan(0.5 * angle * kDegree), 1e6); };
    const std::array<double, 2> cases[] = {{22.6, 22.6}, {5, 40}, {60, 10}, {1, 180}};
    for (const auto& [along, across] : cases) {
        // In the middle of the panel and at its border, where little is left of the holes on one side.
        for (const double place : {0.0, 0.97}) {
            // The first edge of the panel is along y.
            for (const double angle : {0.0, 90.0}) {
                const double s = slope(angle == 0 ? across : along);
                const double t = slope(angle == 0 ? along : across);
                const double expected = double{kFloorAlbedo} / kPi * honeycomb_irradiance(s, t, place);
                const auto [mean, deviation] = sample(along, across, angle, place);
                std::printf("honeycomb %g x %g: noise %.4f\n", along, across, deviation / mean);
                EXPECT_NEAR(mean / expected, 1, 0.01) << along << " " << angle << " " << place;
                EXPECT_LT(deviation, 0.08 * mean) << along << " " << angle << " " << place;
            }
        }
        if (across == scene::kWidestSpread) continue;
        // The test of the test: holes of another shape.
        const double expected =
            double{kFloorAlbedo} / kPi * honeycomb_irradiance(slope(across), slope(along), 0.97);
        EXPECT_GT(std::fabs(sample(along, 0.7 * across, 0, 0.97).mean / expected - 1), 0.01) << along;
    }
}

/// What cameras see from different sides of a honeycomb that is turned by 30 degrees.
TEST(ProfiledLight, HoneycombsLieAlongTheirAngle) {
    const scene::ProfileRequest request{nullptr, scene::kWidestSpread, 30, {60, 20}};
    scene::Scene scene = make_spread_scene(request, false);
    const double s = std::tan(30 * kDegree), t = std::tan(10 * kDegree);
    const double flux = scene::passed_flux({nullptr, scene::kWidestSpread, request.honeycomb});
    for (const double azimuth : {0.0, 30.0, 75.0, 120.0}) {
        const double slope = 0.11;
        // The first edge is along y; seen from below, where it shines to, angles count from y towards x.
        const double edge = azimuth * kDegree;
        const Double3 w{slope * std::sin(edge), slope * std::cos(edge), -1};
        set_camera(scene, to_float(Double3{0.1, 0.1, 1} + 0.5 * w), {0.1f, 0.1f, 1}, {1, 0, 0}, 1e-4, 1, 1);
        render::RenderSettings settings;
        settings.samples = 1;
        const image::Image image = render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
        const double turned = (azimuth - 30) * kDegree;
        const double expected = (1 - slope * std::fabs(std::cos(turned)) / s) *
                                (1 - slope * std::fabs(std::sin(turned)) / t) / flux;
        EXPECT_NEAR(double{image.pixels[1]} / expected, 1, 1e-3) << azimuth;
    }
}

} // namespace
} // namespace nusselt::render_test
