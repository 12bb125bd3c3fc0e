/// Shadow rays in shaders against spheres, disks, ellipses and ellipsoids, compared with those of the CPU.

#include "gpu_shadows.h"
#include "lights/round_scenes.h"
#include "soups.h"

#include "scene/model/lights/round/round_axes.h"

#include <cmath>
#include <cstddef>
#include <random>

namespace nusselt::gpu_visibility_test {
namespace {

using render_test::add_round_light;
using scene::Float3;
using scene::RoundLight;
using scene::RoundModel;
using visibility_test::make_empty_scene;

/// Rays that pass the outline of a light within rounding may hit or miss it.
constexpr double kMostDiffering = 1e-4;
/// Of rays that end on a light, those that end next to its outline, more: the shape that counts is smaller on GPUs.
constexpr double kMostDifferingAtEnds = 2e-3;

class RoundShadows : public GpuShadows {
protected:
    float number(float low, float high) { return std::uniform_real_distribution(low, high)(random_); }
    std::array<float, 3> point(const Float3& center, float size) {
        return {center.x + number(-size, size), center.y + number(-size, size),
                center.z + number(-size, size)};
    }

    /// From and to points of a cube.
    std::vector<Ray> rays_in_cube(const Float3& center, float size, int count) {
        std::vector<Ray> rays;
        for (int i = 0; i < count; ++i) {
            const auto from = point(center, size), to = point(center, size);
            rays.push_back({from, {to[0] - from[0], to[1] - from[1], to[2] - from[2]}, number(0.5f, 2)});
        }
        return rays;
    }

    /// From points of a cube to points on a light, before which they end as those of renderers do.
    std::vector<Ray> rays_to(const RoundLight& light, float size, int count) {
        const scene::RoundAxes axes(light);
        std::vector<Ray> rays;
        for (int i = 0; i < count; ++i) {
            const double angle = number(0, 6.2831853f), z = is_flat(light) ? 0 : number(-1, 1);
            const double radius = is_flat(light) ? std::sqrt(number(0, 1)) : std::sqrt(1 - z * z);
            const Float3 to = to_float(to_double(light.center) +
                                       axes.point({radius * std::cos(angle), radius * std::sin(angle), z}));
            const auto from = point(light.center, size);
            rays.push_back({from, {to.x - from[0], to.y - from[1], to.z - from[2]}, 0.9999f});
        }
        return rays;
    }

    struct Results {
        double blocked = 0, differing = 0; ///< shares of the rays
    };
    Results compare_with_cpu(const scene::Scene& scene, const std::vector<Ray>& rays) const {
        const auto gpu = trace(scene, rays);
        const auto cpu = trace_on_cpu(scene, rays);
        Results results;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            results.blocked += cpu[i];
            results.differing += gpu[i] != cpu[i] ? 1 : 0;
        }
        results.blocked /= static_cast<double>(rays.size());
        results.differing /= static_cast<double>(rays.size());
        return results;
    }
};

INSTANTIATE_TEST_SUITE_P(Ways, RoundShadows, testing::Values(Way::bvh, Way::query),
                         [](const auto& of) { return of.param == Way::bvh ? "bvh" : "query"; });

/// Each shape, next to each other. \param center of the first
std::vector<RoundLight> make_lights(const Float3& center) {
    const auto at = [&](float x) { return Float3{center.x + x, center.y, center.z}; };
    return {
        {.center = at(0), .u = {0.9f, 0, 0}, .v = {0, 0.9f, 0}, .w = {0, 0, 0.9f}},
        {.model = RoundModel::ellipse, .center = at(2), .u = {0, 0.9f, 0}, .v = {0.9f, 0, 0}, .w = {0, 0, 0}},
        {.model = RoundModel::ellipse,
         .center = at(4),
         .u = {0.5f, 0.4f, 0.1f},
         .v = {0, -0.3f, 0.6f},
         .w = {0, 0, 0}},
        {.center = at(6), .u = {0.5f, 0.1f, 0.2f}, .v = {0, 0.8f, 0.1f}, .w = {-0.1f, 0.1f, 0.3f}},
        {.model = RoundModel::hollow, .center = at(3), .u = {5, 0, 0}, .v = {0, 3, 1}, .w = {0, 1, 4}}};
}

scene::Scene scene_of(const std::vector<RoundLight>& lights) {
    scene::Scene scene = make_empty_scene();
    for (const RoundLight& light : lights) add_round_light(scene, light);
    return scene;
}

TEST_P(RoundShadows, MeetTheExactShapes) {
    for (const float far : {0.0f, 300.0f}) {
        const Float3 center = {far, -far, far};
        for (const RoundLight& light : make_lights(center)) {
            const Results results =
                compare_with_cpu(scene_of({light}), rays_in_cube(light.center, 1.5f, 20000));
            EXPECT_LE(results.differing, kMostDiffering) << far;
            EXPECT_GT(results.blocked, light.model == RoundModel::hollow ? 0 : 0.02);
            EXPECT_LT(results.blocked, 0.8);
        }
    }
}

/// The test of the test: the triangles of these lights in their place would be found.
TEST(RoundShadowsOnTheCpu, DifferFromThoseOfTriangles) {
    std::mt19937 random(11);
    const RoundLight light = make_lights({0, 0, 0}).front();
    scene::Scene flat = scene_of({light});
    flat.lights.clear();
    flat.triangle_light.assign(flat.triangles.size(), -1);
    std::uniform_real_distribution<float> number(-1.5f, 1.5f);
    std::vector<Ray> rays;
    for (int i = 0; i < 20000; ++i) {
        const std::array<float, 3> from = {number(random), number(random), number(random)};
        rays.push_back({from, {number(random), number(random), number(random)}, 1});
    }
    const auto exact = trace_on_cpu(scene_of({light}), rays), triangles = trace_on_cpu(flat, rays);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) differing += exact[i] != triangles[i];
    EXPECT_GT(differing, static_cast<std::size_t>(2 * kMostDiffering * 20000));
}

TEST_P(RoundShadows, DoNotHideTheirOwnSamples) {
    for (const float far : {0.0f, 300.0f}) {
        for (const RoundLight& light : make_lights({far, -far, far})) {
            // From points around a light, it hides what is on its back, but no more than on the CPU. Inside, all is
            // seen.
            const Results results = compare_with_cpu(
                scene_of({light}), rays_to(light, light.model == RoundModel::hollow ? 1.5f : 20.0f, 20000));
            EXPECT_LE(results.differing, kMostDifferingAtEnds) << far;
            if (is_flat(light) || light.model == RoundModel::hollow) {
                EXPECT_EQ(results.blocked, 0) << far;
            } else {
                EXPECT_NEAR(results.blocked, 0.5, 0.05) << far;
            }
        }
    }
}

TEST_P(RoundShadows, OfManyLightsAmongTriangles) {
    scene::Scene scene = scene_of(make_lights({0, 0, 0}));
    for (int i = 0; i < 40; ++i) {
        const auto center = point({3, 0, 0}, 4);
        add_round_light(scene, render_test::sphere({center[0], center[1], center[2]}, number(0.01f, 0.4f)));
    }
    visibility_test::add_soup(scene, 30, random_);
    const Results results = compare_with_cpu(scene, rays_in_cube({3, 0, 0}, 4, 20000));
    EXPECT_LE(results.differing, kMostDiffering);
    EXPECT_GT(results.blocked, 0.1);
    EXPECT_LT(results.blocked, 0.9);
}

TEST_P(RoundShadows, LetRaysPassWithTheSameProbabilities) {
    scene::Scene scene = scene_of(make_lights({0, 0, 0}));
    scene.materials[0].alpha = 0.4f;
    const auto rays = rays_in_cube({3, 0, 0}, 4, 20000);
    const Results partial = compare_with_cpu(scene, rays);
    EXPECT_LE(partial.differing, kMostDiffering);
    scene.materials[0].alpha = 1;
    EXPECT_LT(partial.blocked, 0.8 * compare_with_cpu(scene, rays).blocked);
    scene.materials[0].alpha = 0;
    const Results absent = compare_with_cpu(scene, rays);
    EXPECT_EQ(absent.blocked, 0);
    EXPECT_EQ(absent.differing, 0);
}

TEST_P(RoundShadows, LeaveOutLightsThatTheyCannotMeet) {
    // Rays through the origin would meet boxes without a size there.
    scene::Scene scene = scene_of(make_lights({0, 0, 0}));
    scene.materials[0].alpha = 0;
    std::vector<Ray> rays;
    for (int i = 0; i < 1000; ++i) {
        const auto from = point({0, 0, 0}, 4);
        rays.push_back({from, {-2 * from[0], -2 * from[1], -2 * from[2]}, 1});
    }
    EXPECT_EQ(compare_with_cpu(scene, rays).blocked, 0);
    EXPECT_EQ(compare_with_cpu(scene, rays).differing, 0);

    // Nor may coordinates for which no structure has room cost the others.
    scene.materials[0].alpha = 1;
    const auto usual = compare_with_cpu(scene, rays);
    RoundLight far = scene.lights.of<RoundLight>().front();
    far.center = {1e19f, 0, 0};
    add_round_light(scene, far);
    const auto with_far = compare_with_cpu(scene, rays);
    EXPECT_GT(usual.blocked, 0.5);
    EXPECT_EQ(with_far.blocked, usual.blocked);
    EXPECT_LE(with_far.differing, kMostDiffering);
}

} // namespace
} // namespace nusselt::gpu_visibility_test
