/// Shadow rays in shaders: against Embree, against all triangles in double precision, and through the seams of meshes.

#include "gpu_shadows.h"
#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace nusselt::gpu_visibility_test {
namespace {

using visibility::TriangleBvh;
using visibility_test::make_empty_scene;

/// Rounding of rays in single precision, as a share of the coordinates. What is farther from any edge must be right.
constexpr double kMargin = 2e-6;

INSTANTIATE_TEST_SUITE_P(Ways, GpuShadows, testing::Values(Way::bvh, Way::query),
                         [](const auto& of) { return of.param == Way::bvh ? "bvh" : "query"; });

/// The comparison of results with a test of all triangles in double precision.
struct Comparison {
    std::size_t wrong = 0;
    std::size_t undecided = 0; ///< within rounding of an edge or an end
    std::size_t blocked = 0;
};

/// \param flat the scene without instances
Comparison compare(const scene::Scene& flat, const std::vector<Ray>& rays,
                   const std::vector<std::uint32_t>& results, double margin = kMargin) {
    Comparison comparison;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ExactShadow exact = exact_shadow(flat, rays[i], margin);
        comparison.blocked += exact.hits;
        comparison.undecided += !exact.is_decided();
        comparison.wrong += exact.is_decided() && exact.hits != (results[i] != 0);
    }
    return comparison;
}

std::size_t count_blocked(const std::vector<std::uint32_t>& results) {
    return static_cast<std::size_t>(std::count(results.begin(), results.end(), 1u));
}

TEST_P(GpuShadows, OfSoups) {
    for (const int count : {0, 1, 2, 17, 300, 2000}) {
        scene::Scene scene = make_empty_scene();
        visibility_test::add_soup(scene, count, random_);
        const auto rays = random_rays(2000, random_);
        const Comparison gpu = compare(scene, rays, trace(scene, rays));
        EXPECT_EQ(gpu.wrong, 0u) << count;
        EXPECT_LE(gpu.undecided, rays.size() / 50) << count;
        const Comparison cpu = compare(scene, rays, trace_on_cpu(scene, rays));
        EXPECT_EQ(cpu.wrong, 0u) << count;
        if (count >= 300) {
            EXPECT_GT(gpu.blocked, rays.size() / 20) << "the rays tell something";
            EXPECT_LT(gpu.blocked, rays.size() * 19 / 20);
        }
    }
}

TEST_P(GpuShadows, OfNeedles) {
    scene::Scene scene = make_empty_scene();
    add_needles(scene, 1000, random_);
    auto rays = random_rays(2000, random_);
    const auto through = rays_through_triangles(scene, {0, 0, 0}, random_);
    rays.insert(rays.end(), through.begin(), through.begin() + 2000);
    const Comparison gpu = compare(scene, rays, trace(scene, rays));
    EXPECT_EQ(gpu.wrong, 0u);
    EXPECT_LE(gpu.undecided, rays.size() / 2) << "those through vertices and edges are";
    EXPECT_GT(gpu.blocked, 200u);
}

TEST_P(GpuShadows, OfClosedMeshes) {
    scene::Scene scene = make_empty_scene();
    add_bumpy_sphere(scene, 12, 16, {0.5f, -3, 20}, random_);
    auto rays = rays_through_triangles(scene, {0.5f, -3, 20}, random_);
    const auto results = trace(scene, rays);
    EXPECT_EQ(compare(scene, rays, results).wrong, 0u);
    for (Ray& ray : rays) ray.t_far = 0.999f;
    const auto before = trace(scene, rays);
    EXPECT_EQ(compare(scene, rays, before).wrong, 0u);
    EXPECT_LT(count_blocked(before), count_blocked(results) / 2);
}

TEST_P(GpuShadows, HaveNoGapsAtAxisAlignedEdges) {
    scene::Scene scene = make_empty_scene();
    visibility_test::add_box(scene, {-1, -1, -1}, {1, 1, 1});
    std::vector<Ray> rays;
    // Rays go to corners, along axes, and along diagonals of sides, where products vanish.
    for (int i = 0; i < 27; ++i) {
        const std::array<float, 3> direction = {
            static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 % 3 - 1), static_cast<float>(i / 9 - 1)};
        if (i == 13) continue;
        for (const float x : {-0.5f, 0.0f, 0.25f})
            for (const float y : {-0.5f, 0.0f, 0.25f}) rays.push_back({{x, y, 0}, direction, 3});
    }
    EXPECT_EQ(count_blocked(trace(scene, rays)), rays.size());
}

TEST_P(GpuShadows, OfInstances) {
    scene::Scene scene = make_empty_scene();
    visibility_test::add_soup(scene, 20, random_);
    visibility_test::add_soup(scene, 200, random_);
    visibility_test::make_object(scene, 20);
    add_instances(scene, 0, random_);
    const auto rays = random_rays(2000, random_);
    const scene::Scene flat = visibility_test::without_instances(scene);
    // Inverse matrices amplify what is rounded.
    const Comparison gpu = compare(flat, rays, trace(scene, rays), 10 * kMargin);
    EXPECT_EQ(gpu.wrong, 0u);
    EXPECT_LE(gpu.undecided, rays.size() / 50);
    EXPECT_GT(gpu.blocked, rays.size() / 20);
    EXPECT_LT(gpu.blocked, rays.size() * 19 / 20);
    // Surfaces are found in the world alone, and in instances alone.
    scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 20);
    scene.triangle_material.resize(200);
    scene.triangle_light.resize(200);
    scene.objects[0].first_triangle = 0;
    const Comparison alone =
        compare(visibility_test::without_instances(scene), rays, trace(scene, rays), 10 * kMargin);
    EXPECT_EQ(alone.wrong, 0u);
}

TEST_P(GpuShadows, WithAlphaAreThoseOfTheCpu) {
    scene::Scene scene = make_empty_scene();
    visibility_test::add_soup(scene, 300, random_);
    for (std::size_t i = 0; i < 300; ++i) scene.triangle_material[i] = static_cast<std::uint32_t>(i % 3);
    const auto rays = random_rays(4000, random_);
    const auto gpu = trace(scene, rays);
    const auto cpu = trace_on_cpu(scene, rays);
    std::size_t compared = 0, different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (exact_shadow(scene, rays[i], kMargin).unsure) continue;
        ++compared;
        different += gpu[i] != cpu[i];
    }
    EXPECT_GT(compared, rays.size() * 9 / 10);
    EXPECT_EQ(different, 0u) << "decisions are hashes of the same numbers";
    scene::Scene full = scene;
    full.materials[visibility_test::kPartial].alpha = 1;
    EXPECT_LT(count_blocked(gpu), count_blocked(trace(full, rays)) * 98 / 100) << "alpha lets rays pass";
}

/// A square of two triangles in the plane z = 0, its left half cut out by a texture.
scene::Scene make_half_square() {
    scene::Scene scene = make_empty_scene();
    scene.textures.push_back(
        {"half", 2, 1, {0, 1}, 1, scene::TextureWrap::clamp, scene::TextureFilter::nearest});
    scene.materials[visibility_test::kPartial] = {};
    scene.materials[visibility_test::kPartial].alpha_texture.texture = 0;
    visibility_test::add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, visibility_test::kPartial);
    visibility_test::add_triangle(scene, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, visibility_test::kPartial);
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};
    return scene;
}

/// Rays down through a grid, and which of them shall be blocked.
void check_half_square(const std::function<std::vector<std::uint32_t>(const std::vector<Ray>&)>& trace,
                       float shift) {
    std::vector<Ray> rays;
    for (int i = 0; i < 400; ++i) {
        const float x = (static_cast<float>(i % 20) + 0.45f) / 20;
        const float y = (static_cast<float>(i / 20) + 0.3f) / 20;
        rays.push_back({{x + shift, y, 1}, {0, 0, -1}, 2});
    }
    const auto results = trace(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(results[i], i % 20 >= 10 ? 1u : 0u) << i;
}

TEST_P(GpuShadows, KnowWhereOnATriangleTheyAre) {
    const scene::Scene scene = make_half_square();
    check_half_square([&](const auto& rays) { return trace(scene, rays); }, 0);
}

TEST_P(GpuShadows, KnowWhereOnATriangleOfAnInstanceTheyAre) {
    scene::Scene scene = make_half_square();
    visibility_test::make_object(scene, 0);
    scene.instances.push_back({0, {1, 0, 0, 40, 0, 1, 0, 0, 0, 0, 1, 0}});
    scene.instances.push_back({0, {1, 0, 0, 20, 0, 1, 0, 0, 0, 0, 1, 0}});
    for (const float shift : {20.0f, 40.0f})
        check_half_square([&](const auto& rays) { return trace(scene, rays); }, shift);
}

TEST_P(GpuShadows, OfInstancesWithAlphaAreIndependent) {
    // Two copies with alpha 1/2 one behind the other: a quarter passes.
    scene::Scene scene = make_empty_scene();
    visibility_test::add_triangle(scene, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, visibility_test::kPartial);
    visibility_test::make_object(scene, 0);
    for (const float z : {0.0f, 0.5f}) scene.instances.push_back({0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, z}});
    std::vector<Ray> rays;
    std::uniform_real_distribution<float> uniform(0.1f, 0.9f);
    for (int i = 0; i < 10000; ++i) {
        const float x = uniform(random_);
        rays.push_back({{x, uniform(random_), 1}, {0, 0, -1}, 2});
    }
    const double passed = 1 - static_cast<double>(count_blocked(trace(scene, rays))) / 10000;
    EXPECT_NEAR(passed, 0.25, 5 * std::sqrt(0.25 * 0.75 / 10000));
}

TEST_P(GpuShadows, EndBeforeTheLight) {
    scene::Scene scene = make_empty_scene();
    visibility_test::add_triangle(scene, {-1, -1, 1}, {3, -1, 1}, {-1, 3, 1});
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const auto results = trace(scene, {{{0, 0, 0}, {0, 0, 2}, 0.499f},
                                       {{0, 0, 0}, {0, 0, 2}, 0.501f},
                                       {{0, 0, 0}, {0, 0, -2}, 10},
                                       {{0, 0, 1}, {0, 0, 2}, 10}, // from the surface
                                       {{0, 0, 0}, {0, 0, 2}, kInfinity},
                                       {{0, 0, 0}, {1e-20f, 0, 1e-20f}, 2e20f},
                                       {{0, 0, 0}, {1e15f, 0, 1e15f}, 0.9e-15f}});
    EXPECT_EQ(results, (std::vector<std::uint32_t>{0, 1, 0, 0, 1, 1, 0}));
}

TEST_P(GpuShadows, AreBlockedIfInvalid) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    scene::Scene scene = make_empty_scene();
    visibility_test::add_soup(scene, 100, random_);
    std::vector<Ray> rays = {
        {{0, 0, 9}, {0, 0, 0}, 1}, {{0, 0, 9}, {0, 0, 1}, -1}, {{0, 0, 9}, {0, 0, 1}, kNan}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const float x : {kNan, kInfinity, -kInfinity, 2e18f}) {
            rays.push_back({{0, 0, 9}, {0, 0, 1}, 1});
            rays.back().origin[axis] = x;
            rays.push_back({{0, 0, 9}, {0, 0, 1}, 1});
            rays.back().direction[axis] = x;
        }
    const auto results = trace(scene, rays);
    EXPECT_EQ(results, trace_on_cpu(scene, rays));
    EXPECT_EQ(count_blocked(results), rays.size());
}

class BvhShadows : public parity::GpuTest {
protected:
    std::mt19937 random_{11};
};

// Ray queries of software drivers have gaps.
TEST_F(BvhShadows, HaveNoGapsBetweenNeighbours) {
    for (const scene::Float3& centre : {scene::Float3{0, 0, 0}, scene::Float3{3, -50, 700}}) {
        scene::Scene scene = make_empty_scene();
        add_bumpy_sphere(scene, 24, 32, centre, random_);
        const auto rays = rays_through_triangles(scene, centre, random_);
        ASSERT_GT(rays.size(), 20000u);
        EXPECT_EQ(count_blocked(GpuTracer(device(), scene, Way::bvh).trace(rays)), rays.size());
    }
}

TEST_F(BvhShadows, OfInstancesHaveNoGaps) {
    scene::Scene scene = make_empty_scene();
    visibility_test::add_triangle(scene, {50, 50, 50}, {51, 50, 50}, {50, 51, 50});
    add_bumpy_sphere(scene, 24, 32, {0, 0, 0}, random_);
    auto rays = rays_through_triangles(scene, {0, 0, 0}, random_);
    visibility_test::make_object(scene, 1);
    scene.instances.push_back({0, {-2, 0.3f, 0, 0, 0, 2, 0.7f, 0, 0.1f, 0, 1, 0}});
    EXPECT_EQ(count_blocked(GpuTracer(device(), scene, Way::bvh).trace(rays)), rays.size());
}

TEST_F(BvhShadows, DoNotDependOnUnits) {
    scene::Scene scene = make_empty_scene();
    visibility_test::add_soup(scene, 300, random_);
    const auto rays = random_rays(4000, random_);
    const auto expected = GpuTracer(device(), scene, Way::bvh).trace(rays);
    for (const float factor : {std::exp2(-24.0f), std::exp2(40.0f)}) {
        auto scaled_rays = rays;
        for (Ray& ray : scaled_rays)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                ray.origin[axis] *= factor;
                ray.direction[axis] *= factor;
            }
        EXPECT_EQ(GpuTracer(device(), visibility_test::scaled(scene, factor), Way::bvh).trace(scaled_rays),
                  expected);
    }
}

TEST_F(BvhShadows, FindWrongHierarchies) {
    scene::Scene scene = make_empty_scene();
    add_bumpy_sphere(scene, 24, 32, {0, 0, 0}, random_);
    const auto rays = rays_through_triangles(scene, {0, 0, 0}, random_);
    const auto gaps = [&](const TriangleBvh& bvh) {
        return rays.size() - count_blocked(GpuTracer(device(), scene, bvh).trace(rays));
    };
    const TriangleBvh right = visibility::make_triangle_bvh(scene);
    EXPECT_EQ(gaps(right), 0u);
    TriangleBvh shrunk = right;
    for (auto& node : shrunk.nodes)
        for (int axis = 0; axis < 3; ++axis) {
            const float shift = 0.001f * (node.upper[axis] - node.lower[axis]);
            node.lower[axis] += shift;
            node.upper[axis] -= shift;
        }
    EXPECT_GT(gaps(shrunk), 0u) << "smaller boxes";
    TriangleBvh opened = right;
    for (auto& triangle : opened.triangles) triangle.corner[0] += 1e-5f;
    EXPECT_GT(gaps(opened), 0u) << "corners that differ between neighbours";
    TriangleBvh shortened = right;
    --shortened.instances[0].end_node;
    EXPECT_GT(gaps(shortened), 0u) << "a missing leaf";
}

} // namespace
} // namespace nusselt::gpu_visibility_test
