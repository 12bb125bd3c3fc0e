/// The models by which tubes and strips give light, against quadrature over cylinder, caps and rectangle.

#include "scenes.h"

#include <nusselt/estimate/reference_integrals.h>

#include <gtest/gtest.h>

#include <cmath>

namespace nusselt::render_test {
namespace {

using render::RenderSettings;
using render::Strategies;
using render::Technique;
using scene::LineLight;
using scene::TubeModel;

constexpr float kRadiance = 2;
constexpr int kSize = 8;
/// The middle of what the camera sees: in the neighbourhood, light is even enough for its mean to be that of this point.
constexpr float kX = 0.05f, kY = 0.1f;

/// Short and thick, so that the point below it sees much of a cap.
LineLight make_stub(TubeModel model) {
    return {.start = {0, 0, 0.6f},
            .end = {0.2f, -0.1f, 0.9f},
            .radius = 0.15f,
            .radiance = {kRadiance, kRadiance, kRadiance},
            .model = model};
}

LineLight make_strip(float radius) {
    return {.start = {-0.4f, 0.3f, 0.7f},
            .end = {0.6f, 0.3f, 0.7f},
            .radius = radius,
            .radiance = {kRadiance, kRadiance, kRadiance},
            .model = TubeModel::strip,
            .normal = {0, 0.6f, 0.8f}};
}

scene::Scene under(const LineLight& light) {
    scene::Scene scene = make_floor(kSize);
    set_camera(scene, {kX, kY, 0.01f}, {kX, kY, 0}, {0, 1, 0}, 0.01, kSize, kSize);
    add_line_light(scene, "light", light);
    return scene;
}

double mean(const scene::Scene& scene, Technique technique, Strategies strategies, int samples) {
    RenderSettings settings;
    settings.technique = technique;
    settings.strategies = strategies;
    settings.samples = samples;
    const auto result = render_cpu::Renderer(scene, 2).render(settings, base::choose_isa());
    EXPECT_EQ(result.statistics.rejected_samples, 0u);
    return region_means(result.image, 1)[0];
}

/// A shading point at the middle of the picture sees a light from here.
LineSegment<double> seen(const LineLight& light) {
    const auto relative = [](const Float3& p) { return Vec3<double>{p.x - kX, p.y - kY, p.z}; };
    return make_line(relative(light.start), relative(light.end));
}

double lambertian(const Vec3<double>& wi) { return std::max(wi.z, 0.0) / kPi<double>; }

double lateral_radiance(const LineLight& tube) {
    return kFloorAlbedo * kRadiance *
           reference_tube_integral<double>(seen(tube), tube.radius, lambertian, 800, 800);
}
double caps_radiance(const LineLight& tube) {
    return kFloorAlbedo * kRadiance *
           reference_caps_integral<double>(seen(tube), tube.radius, lambertian, 800, 800);
}

constexpr Technique kSampled[] = {Technique::area, Technique::solid_angle, Technique::clipped_solid_angle,
                                  Technique::projected_solid_angle};

TEST(TubeModels, SolidTubesShineFromTheirCaps_OpenOnesDoNot) {
    const LineLight open = make_stub(TubeModel::open);
    const double lateral = lateral_radiance(open);
    const double caps = caps_radiance(open);
    ASSERT_GT(caps, 0.2 * lateral);
    for (const Technique technique : kSampled) {
        SCOPED_TRACE(name_of(technique));
        const auto sampled = [&](TubeModel model) {
            return mean(under(make_stub(model)), technique, Strategies::diffuse, 1024);
        };
        EXPECT_NEAR(sampled(TubeModel::open), lateral, 5e-3 * lateral);
        EXPECT_NEAR(sampled(TubeModel::solid), lateral + caps, 5e-3 * lateral);
    }
}

scene::Scene glossy(scene::Scene scene) {
    scene.materials[0].model = scene::BrdfModel::frostbite;
    scene.materials[0].f0 = {0.3f, 0.3f, 0.3f};
    scene.materials[0].roughness = 0.5f;
    return scene;
}

TEST(TubeModels, PairsOfTechniquesAgreeOnOpenTubes) {
    const scene::Scene scene = glossy(under(make_stub(TubeModel::open)));
    const double expected = mean(scene, Technique::area, Strategies::diffuse, 4096);
    EXPECT_NEAR(mean(scene, Technique::projected_solid_angle, Strategies::diffuse_ltc, 1024), expected,
                5e-3 * expected);
}

/// Lines and disks are off by about the radius over the distance.
TEST(TubeModels, AnalyticShadingFollowsTheModel) {
    LineLight thin = make_stub(TubeModel::open);
    thin.radius = 0.003f;
    const auto analytic = [&](TubeModel model) {
        LineLight light = thin;
        light.model = model;
        return mean(under(light), Technique::ltc_analytic, Strategies::diffuse, 1);
    };
    const double lateral = lateral_radiance(thin);
    const double caps = caps_radiance(thin);
    EXPECT_NEAR(analytic(TubeModel::open), lateral, 0.01 * lateral);
    EXPECT_NEAR(analytic(TubeModel::solid) - analytic(TubeModel::open), caps, 0.02 * caps);
    EXPECT_NEAR(analytic(TubeModel::linear), lateral, 0.01 * lateral);
}

/// A thick tube, mirrored by polished metal.
TEST(TubeModels, NoTubeIsBrighterThanItsWholeLobe) {
    const auto mirrored = [](TubeModel model) {
        scene::Scene scene = under({.start = {kX - 0.7f, kY, 0.3f},
                                    .end = {kX + 0.7f, kY, 0.3f},
                                    .radius = 0.2f,
                                    .radiance = {kRadiance, kRadiance, kRadiance},
                                    .model = model});
        scene.materials[0].model = scene::BrdfModel::frostbite;
        scene.materials[0].diffuse = {0, 0, 0};
        scene.materials[0].f0 = {1, 1, 1};
        scene.materials[0].roughness = 0.2f;
        return mean(scene, Technique::ltc_analytic, Strategies::diffuse, 1);
    };
    EXPECT_LE(mirrored(TubeModel::open), kRadiance);
    EXPECT_GT(mirrored(TubeModel::open), 0.9 * kRadiance);
    EXPECT_GT(mirrored(TubeModel::linear), 1.5 * kRadiance);
}

TEST(TubeModels, StripsAreNarrowRectangles) {
    const LineLight strip = make_strip(0.01f);
    const scene::Scene scene = under(strip);
    const double expected =
        kFloorAlbedo * kRadiance *
        reference_strip_integral<double>(seen(strip), {0, 0.6, 0.8}, 2 * strip.radius, lambertian, 100, 1000);
    for (const Technique technique : kSampled)
        EXPECT_NEAR(mean(scene, technique, Strategies::diffuse, 1024), expected, 2e-3 * expected)
            << name_of(technique);
    EXPECT_NEAR(mean(scene, Technique::ltc_analytic, Strategies::diffuse, 1), expected, 2e-3 * expected);
}

/// The test of the test: another normal, and a tube in place of a strip, are noticed.
TEST(TubeModels, OtherShapesAreNoticed) {
    const LineLight strip = make_strip(0.01f);
    const double expected = mean(under(strip), Technique::ltc_analytic, Strategies::diffuse, 1);
    LineLight turned = strip;
    turned.normal = {0, 0.65f, 0.76f};
    LineLight tube = strip;
    tube.model = TubeModel::linear;
    for (const LineLight& other : {turned, tube})
        EXPECT_GT(
            std::fabs(mean(under(other), Technique::ltc_analytic, Strategies::diffuse, 1) / expected - 1),
            4e-3);
}

/// Looks along the axis, at the cap and past it.
TEST(TubeModels, CamerasSeeDarkCapsOfOpenTubes) {
    for (const TubeModel model : {TubeModel::solid, TubeModel::open}) {
        scene::Scene scene = make_floor(1);
        LineLight tube = make_stub(model);
        tube.start = {0, -1, 1};
        tube.end = {0, 1, 1};
        add_line_light(scene, "tube", tube);
        const auto seen_from = [&](const Float3& eye) {
            set_camera(scene, eye, {0, 0, 1}, {0, 0, 1}, 0.001, 1, 1);
            return mean(scene, Technique::projected_solid_angle, Strategies::diffuse, 1);
        };
        EXPECT_EQ(seen_from({0.01f, -3, 1.01f}), model == TubeModel::solid ? kRadiance : 0);
        EXPECT_EQ(seen_from({0.02f, 4, 1}), model == TubeModel::solid ? kRadiance : 0);
        EXPECT_EQ(seen_from({3, 0.1f, 1}), kRadiance);
        EXPECT_EQ(seen_from({3, -2, 1}), kRadiance);
    }
}

} // namespace
} // namespace nusselt::render_test
