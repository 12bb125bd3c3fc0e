/// Lights with an IES profile or a spread, from files to pixels: the intensity in the far field, the flux, what cameras see, and
/// that all ways to sample them have one expectation.

#include "base/temporary_folder.h"
#include "lossy_tracer.h"
#include "scene/ies/ies_cases.h"
#include "scene/import/importers.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/profiles/profile_radiance.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <string>

namespace nusselt::render_test {
namespace {

using scene::Double3;
using scene::test::Case;
using scene::test::kDegree;
using scene::test::kPi;

constexpr double kSide = 0.7;
constexpr double kHeight = 50 * kSide;
constexpr int kPixels = 20;
constexpr double kAlbedo = 0.5;

/// A square at the height of 50 sizes that shines down, with the half-plane of 0 degrees along +y.
const std::string kSquare = "Shape \"trianglemesh\" \"point3 P\" [ -0.35 -0.35 35  -0.35 0.35 35  "
                            "0.35 0.35 35  0.35 -0.35 35 ] \"integer indices\" [ 0 1 2  0 2 3 ]\n";
/// A closed box around the middle of that square, whose first face is its lower side.
const std::string kBox =
    "Shape \"trianglemesh\" \"point3 P\" [ -0.35 -0.35 34.8  -0.35 0.35 34.8  "
    "0.35 0.35 34.8  0.35 -0.35 34.8  -0.35 -0.35 35.2  -0.35 0.35 35.2  0.35 0.35 35.2  "
    "0.35 -0.35 35.2 ] \"integer indices\" [ 0 1 2  0 2 3  4 6 5  4 7 6  0 5 1  0 4 5  "
    "1 6 2  1 5 6  2 7 3  2 6 7  3 4 0  3 7 4 ]\n";
const std::string kEmission = "AreaLightSource \"diffuse\" \"string ies\" \"lamp.ies\"";
const std::string kPoint = "Translate 0 0 35 Rotate 180 1 1 0 "
                           "LightSource \"point\" \"string ies\" \"lamp.ies\"\n";

/// A floor below a light, as the light sees it.
scene::Scene load(const Case& lamp, const std::string& light) {
    const base::TemporaryFolder folder;
    write(lamp, folder.path());
    std::ofstream(folder / "scene.pbrt")
        << "Film \"rgb\" \"integer xresolution\" " << kPixels << " \"integer yresolution\" " << kPixels
        << "\nPixelFilter \"box\"\nLookAt 0 0 34.7  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 140\n"
        << "WorldBegin\nMaterial \"diffuse\" \"rgb reflectance\" [ 0.5 0.5 0.5 ]\n"
        << "Shape \"trianglemesh\" \"point3 P\" [ -400 -400 0  400 -400 0  400 400 0  -400 400 0 ] "
        << "\"integer indices\" [ 0 1 2  0 2 3 ]\nAttributeBegin\n"
        << light << "AttributeEnd\n";
    return scene::load_scene(folder / "scene.pbrt");
}

scene::Scene load_square(const Case& lamp) { return load(lamp, kEmission + '\n' + kSquare); }

/// A direction of the world in the frame of the square.
Double3 in_profile(const Double3& w) { return {w.y, w.x, -w.z}; }

/// The point of the floor that the centre of a pixel sees.
Double3 floor_point(const scene::Camera& camera, int i, int j) {
    const auto at = [&](float Float3::*axis) {
        return double{camera.corner.*axis} + (i + 0.5) * camera.right.*axis + (j + 0.5) * camera.down.*axis;
    };
    const double t = -camera.origin.z / at(&Float3::z);
    return {camera.origin.x + t * at(&Float3::x), camera.origin.y + t * at(&Float3::y), 0};
}

/// What the floor receives from a light in its middle above it.
image::Image render_floor(const scene::Scene& scene) {
    render::RenderSettings settings;
    settings.samples = 64;
    settings.camera_rays = 1;
    settings.pixel_position = render::PixelPosition::center;
    return render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
}

/// The largest relative error of the intensities that the floor receives. Directions of less than a hundredth of the peak are left
/// out.
double far_field_error(const scene::Camera& camera, const image::Image& floor,
                       const scene::test::Intensity& intensity, double peak) {
    double worst = 0;
    for (int j = 0; j < kPixels; ++j)
        for (int i = 0; i < kPixels; ++i) {
            const Double3 way = floor_point(camera, i, j) - Double3{0, 0, kHeight};
            const double squared = dot(way, way);
            const Double3 w = normalized(way);
            const double expected = intensity(in_profile(w));
            if (expected < 0.01 * peak) continue;
            const double radiance = double{floor.pixels[static_cast<std::size_t>(3 * (j * kPixels + i))]};
            const double found = radiance * kPi / kAlbedo * scene::kLumensPerWatt * squared / -w.z;
            worst = std::max(worst, std::fabs(found / expected - 1));
        }
    return worst;
}

double far_field_error(const scene::Scene& scene, const scene::test::Intensity& intensity, double peak) {
    return far_field_error(scene.camera, render_floor(scene), intensity, peak);
}

const scene::IntensityProfile& table_of(const scene::Scene& scene) {
    return scene.emission_profiles.at(0).profile->luminaire->profile;
}

/// The flux of all polygons [lm].
double flux_of(const scene::Scene& scene) {
    double flux = 0;
    for (const scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>())
        flux += (light.two_sided ? 2 : 1) * kPi * area(light) * double{light.radiance.y};
    return scene::kLumensPerWatt * flux;
}

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
        const scene::IntensityProfile& table = table_of(scene);
        const double peak = table.peak().candelas;
        const image::Image floor = render_floor(scene);
        const auto error = [&](const scene::test::Intensity& intensity) {
            return far_field_error(scene.camera, floor, intensity, peak);
        };
        EXPECT_LT(error([&](const Double3& w) { return table.intensity(w); }), 0.01) << lamp.name;
        // The tests of the test: the other handedness of horizontal angles, and a light that is darker by 3 %.
        rejected_mirrored += error([&](const Double3& w) {
                                 return table.intensity({w.x, -w.y, w.z});
                             }) >= 0.01
                                 ? 1
                                 : 0;
        rejected_bright += error([&](const Double3& w) { return 1.03 * table.intensity(w); }) >= 0.01 ? 1 : 0;
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
scene::Scene make_spread_scene(double spread, bool two_sided) {
    scene::Scene scene = make_floor(8);
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add_polygon_light(scene, {Float3{-1, -1, 1}, Float3{-1, 1, 1}, Float3{1, 1, 1}, Float3{1, -1, 1}},
                      {1, 1, 1}, two_sided, 1);
    scene::PolygonLight& light = scene.lights.of<scene::PolygonLight>().back();
    const auto shape = scene::profile_shape(std::span(&light, 1), 0, {nullptr, spread, 0});
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

TEST(ProfiledLight, SpreadKeepsThePowerAndAddsLittleNoise) {
    for (const double spread : {1.0, 5.0, 20.0, 60.0}) {
        for (const bool two_sided : {false, true}) {
            const scene::Scene scene = make_spread_scene(spread, two_sided);
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
            const double deviation = std::sqrt(std::max(squares / kCount - mean * mean, 0.0));
            const double expected = double{kFloorAlbedo} / kPi * spread_irradiance(spread);
            EXPECT_NEAR(mean / expected, 1, 0.01) << spread;
            EXPECT_LT(deviation, 0.08 * mean) << spread;
        }
    }
}

} // namespace
} // namespace nusselt::render_test
