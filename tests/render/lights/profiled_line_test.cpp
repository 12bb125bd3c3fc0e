/// Tubes, lines and strips with an IES profile or a spread, from files to pixels: the intensity in the far field, the flux, what
/// cameras see, and that all ways to sample them have one expectation.

#include "lights/far_field.h"
#include "lossy_tracer.h"
#include "scene/model/profiles/line_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

namespace nusselt::render_test {
namespace {

using scene::LineLight;
using scene::TubeModel;

constexpr TubeModel kModels[] = {TubeModel::linear, TubeModel::solid, TubeModel::open, TubeModel::strip};
constexpr double kRadius = 0.02;

/// A light in the place of the square of far_field.h, with the half-plane of 0 degrees along it.
std::string shape_text(TubeModel model) {
    const std::string ends = "Shape \"line\" \"point3 p0\" [ 0 -0.35 35 ] \"point3 p1\" [ 0 0.35 35 ] ";
    if (model == TubeModel::strip) return ends + "\"normal N\" [ 0 0 -1 ] \"float width\" 0.04\n";
    return ends + "\"float radius\" 0.02 \"vector3 profileaxis\" [ 0 0 -1 ] \"bool finite\" " +
           (model == TubeModel::linear ? "false" : "true") +
           (model == TubeModel::open ? " \"string caps\" \"dark\"" : "") + "\n";
}

/// The area that a direction sees of the light.
double visible_area(TubeModel model, const Double3& w) {
    const double section = 2 * kRadius * kSide;
    if (model == TubeModel::strip) return section * std::fabs(w.z);
    const double cap = model == TubeModel::solid ? kPi * kRadius * kRadius : 0;
    return section * std::sqrt(std::max(1 - w.x * w.x, 0.0)) + cap * std::fabs(w.x);
}

/// The flux of a luminaire that leaves a light [lm].
double emitted_flux(TubeModel model, const scene::test::Intensity& intensity) {
    constexpr int kRows = 1500, kColumns = 600;
    const double least = scene::kGrazingCosine * 2 * kRadius * kSide;
    double sum = 0;
    for (int i = 0; i < kRows; ++i) {
        const double x = std::cos(kPi * (i + 0.5) / kRows);
        const double radius = std::sqrt(1 - x * x);
        for (int j = 0; j < kColumns; ++j) {
            const double azimuth = 2 * kPi * (j + 0.5) / kColumns;
            const Double3 w{x, radius * std::cos(azimuth), radius * std::sin(azimuth)};
            sum += radius * intensity(w) * std::min(visible_area(model, w) / least, 1.0);
        }
    }
    return sum * 2 * kPi * kPi / (double{kRows} * kColumns);
}

class ProfiledLineModels : public testing::TestWithParam<TubeModel> {};

TEST_P(ProfiledLineModels, FarFieldAndFluxAreThoseOfTheFile) {
    const TubeModel model = GetParam();
    std::size_t tested = 0, rejected_mirrored = 0, rejected_bright = 0;
    for (const Case& lamp : scene::test::cases()) {
        if (lamp.name != "sphere, 1986" && lamp.name != "askew, 2002" &&
            lamp.name != "direct and indirect, 2019" && lamp.name != "batwing across 0, 1995")
            continue;
        ++tested;
        const scene::Scene scene = load(lamp, kEmission + '\n' + shape_text(model));
        ASSERT_EQ(scene.lights.of<LineLight>().size(), 1u);
        EXPECT_TRUE(scene.warnings.empty());
        const double emitted = emitted_flux(model, lamp.intensity);
        EXPECT_NEAR(flux_of(scene) / emitted, 1, 0.005) << lamp.name;
        EXPECT_NEAR(scene.emission_profiles.at(0).profile->lost, 1 - emitted / *lamp.flux, 0.005)
            << lamp.name;
        // Those on the dark caps of open tubes are in vain.
        const image::Image floor = render_floor(scene, model == TubeModel::open ? 1024 : 64);
        const FarField far = far_field_of(scene.camera, floor, table_of(scene));
        EXPECT_LT(far.error, FarField::kLimit) << lamp.name;
        // The tests of the test.
        rejected_mirrored += far.rejects_mirrored ? 1 : 0;
        rejected_bright += far.rejects_bright ? 1 : 0;
    }
    EXPECT_EQ(tested, 4u);
    EXPECT_EQ(rejected_mirrored, 1u);
    EXPECT_EQ(rejected_bright, tested);
}

/// A luminaire that shines along the light, which shows least of itself there.
TEST_P(ProfiledLineModels, TellWhatTheyCannotEmit) {
    Case lamp = scene::test::cases().at(10);
    lamp.intensity = [](const Double3& w) { return 1000 * std::pow(std::max(w.x, 0.0), 400.0); };
    lamp.file.vertical = scene::test::angles(0, 180, 0.5);
    lamp.file.horizontal = scene::test::angles(0, 360, 1);
    const scene::Scene scene = load(lamp, kEmission + '\n' + shape_text(GetParam()));
    const double emitted = emitted_flux(GetParam(), lamp.intensity);
    const double all = 1000 * 2 * kPi / 401;
    EXPECT_NEAR(flux_of(scene) / all, emitted / all, 0.005);
    const bool emits_all = GetParam() == TubeModel::solid;
    EXPECT_EQ(emitted / all > 0.99, emits_all) << emitted / all;
    ASSERT_EQ(scene.warnings.size(), emits_all ? 0u : 1u);
    if (emits_all) return;
    EXPECT_NE(scene.warnings[0].find("% of the flux of 'lamp.ies', which leaves"), std::string::npos);
    EXPECT_NE(scene.warnings[0].find(GetParam() == TubeModel::strip ? "closed box" : "closed tube"),
              std::string::npos);
}

TEST_P(ProfiledLineModels, CamerasSeeTheRadiance) {
    const Case lamp = scene::test::cases().at(10);
    scene::Scene scene = load(lamp, kEmission + '\n' + shape_text(GetParam()));
    for (const double angle : {0.0, 25.0, 50.0}) {
        const Double3 w{std::sin(angle * kDegree) * 0.6, std::sin(angle * kDegree) * 0.8,
                        -std::cos(angle * kDegree)};
        const Double3 eye = Double3{0, 0, kHeight} + 5.0 * w;
        set_camera(scene, to_float(eye), {0, 0, static_cast<float>(kHeight)}, {1, 0, 0}, 1e-5, 1, 1);
        render::RenderSettings settings;
        settings.samples = 1;
        const image::Image image = render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
        const Double3 in_frame = in_profile(w);
        const double expected =
            lamp.intensity(in_frame) / (scene::kLumensPerWatt * visible_area(GetParam(), in_frame));
        EXPECT_NEAR(double{image.pixels[1]} / expected, 1, 0.01) << angle;
    }
}

/// A luminaire that shines askew.
std::shared_ptr<const scene::Luminaire> askew() {
    const base::TemporaryFolder folder;
    const auto profile =
        scene::make_profile(scene::read_ies(write(scene::test::cases().at(10), folder.path())));
    return std::make_shared<const scene::Luminaire>(scene::Luminaire{"lamp", "lamp", profile});
}

constexpr int kFloorSize = 8;

/// A floor close below a light.
scene::Scene make_lit_floor(TubeModel model, const scene::ProfileRequest& request) {
    scene::Scene scene = make_floor(kFloorSize);
    set_camera(scene, {0, -0.1f, 0.1f}, {0, 0, 0}, {0, 1, 0}, 3, kFloorSize, kFloorSize);
    LineLight light{.start = {-0.5f, 0.1f, 0.15f},
                    .end = {0.6f, -0.1f, 0.4f},
                    .radius = 0.03f,
                    .radiance = {1, 2, 3},
                    .model = model,
                    .normal = {0.2195121f, 0, -0.9756098f}};
    light.normal = perpendicular_to_line(light, to_double(light.normal));
    scene::ProfiledShape shape = profile_line(light, request);
    light.profile = 0;
    scene.emission_profiles = std::move(shape.emissions);
    add_line_light(scene, "light", light);
    return scene;
}

render::RenderSettings make_settings(int samples) {
    render::RenderSettings settings;
    settings.samples = samples;
    settings.camera_rays = 1;
    settings.pixel_position = render::PixelPosition::center;
    return settings;
}

std::vector<std::vector<double>> rows_of(const render_cpu::Renderer& renderer,
                                         const render::RenderSettings& settings) {
    return render_region_means(renderer, settings, kSeeds, renderer.visibility().tracer());
}

TEST_P(ProfiledLineModels, AllWaysToSampleHaveTheSameExpectation) {
    const auto lamp = askew();
    const scene::Scene scene = make_lit_floor(GetParam(), {lamp, 120, 30});
    const render_cpu::Renderer renderer(scene, 2);
    render::RenderSettings settings = make_settings(256);
    settings.technique = render::Technique::solid_angle;
    const auto reference = rows_of(renderer, settings);
    settings = make_settings(64);
    settings.emission_sampling = render::EmissionSampling::measure;
    EXPECT_LT(largest_t(rows_of(renderer, settings), reference), kLargestT);
    settings.emission_sampling = render::EmissionSampling::product;
    EXPECT_LT(largest_t(rows_of(renderer, settings), reference), kLargestT);
    settings.strategies = render::Strategies::diffuse_ltc;
    EXPECT_LT(largest_t(rows_of(renderer, settings), reference), kLargestT);
    const LossyTracer mutant(renderer.visibility().tracer(), 0.03);
    EXPECT_GT(largest_t(render_region_means(renderer, settings, kSeeds, mutant.tracer()), reference),
              kLargestT);
    const scene::Scene turned = make_lit_floor(GetParam(), {lamp, 120, 40});
    EXPECT_GT(largest_t(rows_of(render_cpu::Renderer(turned, 2), settings), reference), kLargestT);
}

TEST_P(ProfiledLineModels, AnalyticShadingIsCloseToSamples) {
    const scene::Scene scene = make_lit_floor(GetParam(), {askew(), scene::kWidestSpread, 30});
    const render_cpu::Renderer renderer(scene, 2);
    render::RenderSettings settings = make_settings(256);
    const auto mean = [&] { return region_means(renderer.render(settings, base::choose_isa()).image, 1)[0]; };
    const double sampled = mean();
    settings.technique = render::Technique::ltc_analytic;
    // Caps and the radius of tubes are approximations.
    EXPECT_NEAR(mean(), sampled, 0.03 * sampled);
}

std::string name_of(const testing::TestParamInfo<TubeModel>& info) {
    constexpr const char* kNames[] = {"Linear", "Solid", "Open", "Strip"};
    return kNames[static_cast<std::size_t>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(All, ProfiledLineModels, testing::ValuesIn(kModels), name_of);

TEST(ProfiledLine, ProductsHaveLittleNoise) {
    for (const TubeModel model : {TubeModel::linear, TubeModel::strip}) {
        const scene::Scene scene = make_lit_floor(model, {askew(), 60, 30});
        const render_cpu::Renderer renderer(scene, 2);
        render::RenderSettings settings = make_settings(1);
        settings.sample_order = render::SampleOrder::independent;
        const auto noise = [&](render::EmissionSampling sampling) {
            settings.emission_sampling = sampling;
            const auto rows = rows_of(renderer, settings);
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
        const double measure = noise(render::EmissionSampling::measure);
        const double product = noise(render::EmissionSampling::product);
        std::printf("noise %.5f with products, %.5f without\n", product, measure);
        EXPECT_LT(product, 0.2 * measure);
    }
}

/// A spread keeps the power: what a long line gives to a plane below it, all of it above the plane.
TEST(ProfiledLine, SpreadKeepsThePower) {
    for (const double spread : {5.0, 40.0, 120.0}) {
        for (const TubeModel model : kModels) {
            LineLight light{.end = {0, 0, 1},
                            .radius = 0.02f,
                            .radiance = {1, 1, 1},
                            .model = model,
                            .normal = {1, 0, 0}};
            const scene::ProfiledShape shape = profile_line(light, {nullptr, spread, 0});
            // The flux of the radiance f / mean by brute force over points of the surface and directions around their normals.
            const double slope = std::tan(0.5 * spread * kDegree);
            double share = 0;
            constexpr int kSteps = 4000;
            for (int i = 0; i < kSteps; ++i) {
                const double angle = std::atan(slope) * (i + 0.5) / kSteps;
                share += 2 * std::sin(angle) * std::cos(angle) * (1 - std::tan(angle) / slope) *
                         std::atan(slope) / kSteps;
            }
            EXPECT_NEAR(double{shape.emissions.at(0).mean} / share, 1, 1e-4) << spread;
            // What directions see of the lateral surface adds up to the same.
            const scene::TubeSpread table = scene::tube_spread(slope);
            double seen = 0;
            for (int i = 0; i < kSteps; ++i) {
                const double angle = kPi * (i + 0.5) / kSteps;
                const double sine = std::sin(angle);
                seen += 2 / kPi * sine * sine * kPi / kSteps *
                        scene::passed_share_of_tube(table, std::fabs(std::cos(angle)) / (sine * slope));
            }
            EXPECT_NEAR(seen / share, 1, 2e-3) << spread;
        }
    }
}

/// A light along y, 1 m above a floor, which shines down through a spread.
scene::Scene make_narrow(TubeModel model, double spread, double length) {
    scene::Scene scene = make_floor(1);
    const float end = static_cast<float>(0.5 * length);
    LineLight light{.start = {0, -end, 1},
                    .end = {0, end, 1},
                    .radius = static_cast<float>(kRadius),
                    .radiance = {1, 1, 1},
                    .model = model,
                    .normal = {0, 0, -1}};
    scene::ProfiledShape shape = profile_line(light, {nullptr, spread, 0});
    light.profile = 0;
    scene.emission_profiles = std::move(shape.emissions);
    add_line_light(scene, "light", light);
    return scene;
}

float pixel_of(const scene::Scene& scene, int samples) {
    return render_cpu::Renderer(scene, 1).render(make_settings(samples), base::choose_isa()).image.pixels[0];
}

constexpr double kNarrowSpreads[] = {scene::kNarrowestSpread, 0.1, 1};

/// The sine of such angles vanishes in the rounding of the cosine.
TEST(ProfiledLine, CamerasSeeNarrowSpreads) {
    for (const double spread : kNarrowSpreads) {
        const double slope = std::tan(0.5 * spread * kDegree);
        const double mean = 1 - std::atan(slope) / slope;
        for (const TubeModel model : {TubeModel::solid, TubeModel::strip}) {
            scene::Scene scene = make_narrow(model, spread, 1);
            for (const double part : {0.0, 0.3, 0.6, 0.9, 1.2}) {
                set_camera(scene, {0, static_cast<float>(0.9 * part * slope), 0.1f}, {0, 0, 1}, {1, 0, 0},
                           1e-6, 1, 1);
                EXPECT_NEAR(pixel_of(scene, 1) * mean, std::max(1 - part, 0.0), 0.003)
                    << spread << ' ' << part;
            }
        }
    }
}

/// What a light that is longer than its bright part, even much longer, gives to the point below it. Bright are a disc of slopes on
/// a cylinder and a part of a strip, which counts as a line.
TEST(ProfiledLine, NarrowSpreadsLightTheFloor) {
    for (const double spread : kNarrowSpreads) {
        const double slope = std::tan(0.5 * spread * kDegree);
        for (const TubeModel model : {TubeModel::solid, TubeModel::strip}) {
            for (const double length : {3 * slope, 10.0}) {
                scene::Scene scene = make_narrow(model, spread, length);
                set_camera(scene, {0, -0.1f, 0.1f}, {0, 0, 0}, {0, 1, 0}, 1e-6, 1, 1);
                const bool is_strip = model == TubeModel::strip;
                const double expected = kRadius * (is_strip ? 6 / slope : kPi);
                // Of the samples on the tube, few are in the bright band along it. They are stratified.
                const int samples = is_strip ? 256 : 1 << 18;
                const double tolerance = 0.003 + (is_strip ? 0 : 1 / (samples * slope));
                const double found = pixel_of(scene, samples) * kPi / double{kFloorAlbedo};
                EXPECT_NEAR(found / expected, 1, tolerance) << spread << ' ' << length;
            }
        }
    }
}

} // namespace
} // namespace nusselt::render_test
