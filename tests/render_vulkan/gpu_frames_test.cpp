/// The measurements of `nusselt-lab bench gpu`.

#include "common/source_folder.h"
#include "lab/timing/gpu_frames.h"

#include "gpu_test.h"

#include "render/film.h"
#include "scene/import/importers.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace nusselt::render_vulkan_test {
namespace {

using lab::GpuFrame;
using lab::GpuFrameTimes;
using lab::is_same;
using lab::ratio_of;
using render_vulkan::DeviceScene;
using render_vulkan::ShadowRays;

scene::Scene load_small(const std::string& name) {
    scene::Scene scene = scene::load_scene(std::string(nusselt_test::kSourceFolder) + "/scenes/" + name);
    render::resize_film(scene, 32, 24);
    return scene;
}

TEST(GpuFrameRatios, AreMediansOfRounds) {
    const GpuFrameTimes a{{1, 1, 1}, {5, 3, 7}, 30}, b{{1, 1, 3}, {1, 1, 1}, 20};
    const lab::GpuFrameRatio ratio = ratio_of(a, b);
    EXPECT_EQ(ratio.shading, 5);
    EXPECT_EQ(ratio.whole, 2) << "of 3, 2 and 2";
    EXPECT_EQ(ratio.shadow_rays, 1.5);
    EXPECT_EQ(ratio_of({{1}, {1}, 0}, {{1}, {1}, 0}).shadow_rays, std::nullopt);
}

TEST(GpuFrameTimes, OfOneMoreSampleAreMediansOfDifferences) {
    EXPECT_EQ(lab::additional_time({{1, 1, 1}, {5, 3, 7}, 30}, {{1, 1, 3}, {1, 2, 1}, 20}), 4)
        << "of 4, 1 and 4; the difference of the medians is 3";
}

TEST(TimedSettings, AreAllThatFitAndHoldThePairs) {
    const auto all = lab::timed_settings();
    EXPECT_EQ(all.size(), 11u)
        << "six alone, two with lobes, two with visible normals, one with more samples";
    for (const lab::SettingsPair& pair : {lab::strategies_pair(), lab::sample_pair()}) {
        int ours = 0, baseline = 0;
        for (const render::RenderSettings& settings : all) {
            EXPECT_NO_THROW(validate(settings));
            EXPECT_EQ(camera_ray_count(settings), 1);
            ours += is_same(settings, pair.ours);
            baseline += is_same(settings, pair.baseline);
        }
        EXPECT_EQ(ours, 1);
        EXPECT_EQ(baseline, 1);
    }
    EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const auto& s) { return s.samples == 2; }), 10);
    const lab::SettingsPair pair = lab::sample_pair();
    EXPECT_EQ(pair.ours.samples - pair.baseline.samples, 1);
}

TEST(LineAndQuad, HaveTheSamePlaceAndSize) {
    for (const char* name : {"room.pbrt", "cornell-tube.pbrt"}) {
        const scene::Scene scene = load_small(name);
        const auto both = lab::line_and_quad(scene);
        ASSERT_TRUE(both) << name;
        ASSERT_EQ(both->line.lights.of<scene::LineLight>().size(), 1u);
        EXPECT_TRUE(both->line.lights.of<scene::PolygonLight>().empty());
        ASSERT_EQ(both->quad.lights.of<scene::PolygonLight>().size(), 1u);
        EXPECT_TRUE(both->quad.lights.of<scene::LineLight>().empty());
        const scene::LineLight& line = both->line.lights.of<scene::LineLight>()[0];
        EXPECT_EQ(line.model, scene::TubeModel::linear);
        const scene::PolygonLight& quad = both->quad.lights.of<scene::PolygonLight>()[0];
        EXPECT_TRUE(quad.two_sided);
        ASSERT_EQ(quad.vertices.size(), 4u);
        const auto corner = [&](std::size_t i) { return scene::to_double(quad.vertices[i]); };
        const double length = scene::length(scene::to_double(line.end) - scene::to_double(line.start));
        const scene::Double3 normal = cross(corner(1) - corner(0), corner(3) - corner(0));
        EXPECT_NEAR(scene::length(normal) / (2 * line.radius * length), 1, 1e-5);
        EXPECT_GT(std::fabs(normal.y), 0.5 * scene::length(normal)) << "faces up and down";
        const scene::Double3 middle = 0.5 * (corner(0) + corner(2));
        const scene::Double3 expected = 0.5 * (scene::to_double(line.start) + scene::to_double(line.end));
        EXPECT_LT(scene::length(middle - expected), 1e-5);
        EXPECT_EQ(quad.radiance.y, line.radiance.y);
        EXPECT_EQ(line.radiance.y, scene.lights.of<scene::LineLight>()[0].radiance.y);
    }
    EXPECT_FALSE(lab::line_and_quad(load_small("cornell-panel.pbrt")));
}

TEST(LineAndQuad, TurnsQuadsOfUprightTubes) {
    scene::Scene scene = load_small("cornell-tube.pbrt");
    scene.lights.of<scene::LineLight>()[0].start = {0, 0.5f, 0};
    scene.lights.of<scene::LineLight>()[0].end = {0, 1.5f, 0};
    const auto both = lab::line_and_quad(scene);
    ASSERT_TRUE(both);
    for (const scene::Float3& vertex : both->quad.lights.of<scene::PolygonLight>()[0].vertices) {
        EXPECT_EQ(vertex.x, 0);
        EXPECT_NEAR(std::fabs(vertex.z), scene.lights.of<scene::LineLight>()[0].radius, 1e-6);
    }
}

class GpuFrames : public parity::GpuTest {};

/// Shadow rays of both members of the pair, for a surface that reflects diffusely and specularly everywhere: each sample of
/// a light takes one ray, one of visible normals only if it hits the light.
bool has_rays_of_equal_samples(const lab::GpuFrameRatio& ratio) {
    return ratio.shadow_rays && *ratio.shadow_rays >= 1 && *ratio.shadow_rays <= 2.05;
}

TEST_F(GpuFrames, ComparesStrategiesAtEqualSamples) {
    const scene::Scene scene = load_small("cornell-panel.pbrt");
    const auto pair = lab::strategies_pair();
    const DeviceScene device_scene(device(), scene, ShadowRays::bvh);
    render::RenderSettings more = pair.baseline;
    more.samples *= 4;
    const GpuFrame frames[] = {
        {&device_scene, pair.ours}, {&device_scene, pair.baseline}, {&device_scene, more}};
    const auto times = lab::time_gpu_frames(frames, {.repetitions = 3, .warm_up = 1});
    ASSERT_EQ(times.size(), 3u);
    for (const GpuFrameTimes& t : times) {
        ASSERT_EQ(t.visibility.size(), 3u);
        ASSERT_EQ(t.shading.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_GT(t.visibility[i], 0);
            EXPECT_GT(t.shading[i], 0);
        }
    }
    const lab::GpuFrameRatio ratio = ratio_of(times[0], times[1]);
    RecordProperty("shadow_ray_ratio", std::to_string(ratio.shadow_rays.value_or(0)));
    EXPECT_TRUE(has_rays_of_equal_samples(ratio));
    EXPECT_LE(times[0].shadow_rays, 2 * 2 * 32 * 24u) << "two techniques, two samples, one light";
    EXPECT_GT(times[0].shadow_rays, 2 * 32 * 24u);
    EXPECT_FALSE(has_rays_of_equal_samples(ratio_of(times[0], times[2]))) << "four times the samples";
}

TEST_F(GpuFrames, CountsTheSameRaysWithoutTracingThem) {
    const scene::Scene scene = load_small("cornell-panel.pbrt");
    const DeviceScene traced(device(), scene, ShadowRays::bvh), untraced(device(), scene, ShadowRays::none);
    // The first test has compiled the shader of these settings.
    render::RenderSettings settings = lab::strategies_pair().baseline;
    settings.samples = 2;
    settings.camera_rays = 1;
    const GpuFrame frames[] = {{&traced, settings}, {&untraced, settings}};
    const auto times = lab::time_gpu_frames(frames, {.repetitions = 1, .warm_up = 0});
    EXPECT_EQ(times[0].shadow_rays, times[1].shadow_rays);
    EXPECT_GT(times[0].shadow_rays, 0u);
}

} // namespace
} // namespace nusselt::render_vulkan_test
