/// Surfaces that are there with a probability.

#include "scenes.h"

#include "image/metrics.h"
#include "visibility/alpha.h"
#include "visibility/embree_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace nusselt::render_test {
namespace {

using visibility::HitPacket;
using visibility::RayPacket;

scene::Material make_material(float alpha, int texture) {
    scene::Material material;
    material.alpha = alpha;
    material.alpha_texture.texture = texture;
    return material;
}

/// The unit square at a height, texture coordinates as x and y.
void add_unit_square(scene::Scene& scene, float z, int material) {
    add_quad(scene, {Float3{0, 0, z}, Float3{1, 0, z}, Float3{1, 1, z}, Float3{0, 1, z}}, material);
    const std::size_t first = scene.uvs.size() - 4;
    for (std::size_t i = first; i < scene.uvs.size(); ++i)
        scene.uvs[i] = {scene.positions[i].x, scene.positions[i].y};
}

/// Makes all triangles an object with one copy in the same place.
scene::Scene as_instance(scene::Scene scene) {
    scene.objects.push_back({"object", 0, static_cast<std::uint32_t>(scene.triangles.size())});
    scene.instances.push_back({});
    return scene;
}

/// A ray down through each point of the unit square, slightly tilted.
template <int N>
RayPacket<N> rays_through(const std::vector<scene::Float2>& points, std::size_t first) {
    RayPacket<N> rays{};
    for (int i = 0; i < N; ++i) {
        const scene::Float2& p = points[first + static_cast<std::size_t>(i)];
        rays.origin[0][i] = p.x;
        rays.origin[1][i] = p.y;
        rays.origin[2][i] = 2;
        rays.direction[0][i] = 1e-6f * p.x;
        rays.direction[1][i] = -1e-6f * p.y;
        rays.direction[2][i] = -1;
        rays.t_far[i] = std::numeric_limits<float>::infinity();
    }
    return rays;
}

std::vector<scene::Float2> random_points(std::size_t count) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<float> uniform(0.001f, 0.999f);
    std::vector<scene::Float2> points(count);
    for (scene::Float2& p : points) p = {uniform(generator), uniform(generator)};
    return points;
}

struct Answers {
    std::vector<std::int32_t> triangle;
    std::vector<bool> is_occluded;
};

template <int N>
Answers trace(const scene::Scene& scene, const std::vector<scene::Float2>& points) {
    const visibility::EmbreeScene embree(scene);
    const visibility::RayTracer tracer = embree.tracer();
    const visibility::PacketTracer<N>& packets = tracer;
    constexpr auto kAll = static_cast<std::uint32_t>((std::uint64_t{1} << N) - 1);
    Answers answers;
    for (std::size_t first = 0; first + N <= points.size(); first += N) {
        const RayPacket<N> rays = rays_through<N>(points, first);
        HitPacket<N> hits;
        packets.intersect(tracer.context, kAll, rays, hits);
        const std::uint32_t occluded = packets.occluded(tracer.context, kAll, rays);
        for (int i = 0; i < N; ++i) {
            answers.triangle.push_back(hits.triangle[i]);
            answers.is_occluded.push_back((occluded >> i & 1u) != 0);
        }
    }
    return answers;
}

constexpr std::size_t kRays = 1 << 16;
/// A binomial share is within five standard deviations except in one case in 2 million.
double tolerance(double share) { return 5 * std::sqrt(share * (1 - share) / kRays); }

/// Shares of rays that hit something, by camera rays and by shadow rays.
std::pair<double, double> hit_shares(const scene::Scene& scene) {
    const Answers answers = trace<8>(scene, random_points(kRays));
    double hits = 0;
    double occluded = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
        hits += answers.triangle[i] >= 0 ? 1.0 / kRays : 0;
        occluded += answers.is_occluded[i] ? 1.0 / kRays : 0;
    }
    return {hits, occluded};
}

TEST(Alpha, IsTheShareOfRaysThatHit) {
    for (const float alpha : {0.0f, 0.01f, 0.25f, 0.5f, 0.9f, 1.0f}) {
        scene::Scene scene;
        scene.materials = {make_material(alpha, -1)};
        add_unit_square(scene, 0, 0);
        for (const scene::Scene& variant : {scene, as_instance(scene)}) {
            const auto [hits, occluded] = hit_shares(variant);
            EXPECT_NEAR(hits, alpha, tolerance(alpha));
            EXPECT_NEAR(occluded, alpha, tolerance(alpha));
        }
    }
}

TEST(Alpha, OfLayersIsIndependent) {
    scene::Scene scene;
    scene.materials = {make_material(0.5f, -1), make_material(0.3f, -1)};
    add_unit_square(scene, 0, 0);
    add_unit_square(scene, 0.5f, 1);
    add_unit_square(scene, 1, 0);
    // Two copies in one place are two layers as well.
    scene::Scene copies = as_instance(scene);
    copies.instances.push_back({});
    const double passed = 0.5 * 0.7 * 0.5;
    for (const auto& [variant, expected] : {std::pair{scene, 1 - passed}, {copies, 1 - passed * passed}}) {
        const auto [hits, occluded] = hit_shares(variant);
        EXPECT_NEAR(hits, expected, tolerance(expected));
        EXPECT_NEAR(occluded, expected, tolerance(expected));
    }
}

/// The outcome depends on ray and triangle, not on the packet; surfaces behind and beside stay what they are.
TEST(Alpha, IsTheSameInPacketsOfAllWidths) {
    scene::Scene scene;
    scene.materials = {make_material(0.5f, -1), make_material(1, -1), make_material(0, -1)};
    add_unit_square(scene, 1.2f, 2);
    add_unit_square(scene, 0, 1);
    add_unit_square(scene, 1, 0);
    const auto points = random_points(4096);
    const Answers four = trace<4>(scene, points);
    EXPECT_EQ(four.triangle, trace<8>(scene, points).triangle);
    EXPECT_EQ(four.triangle, trace<16>(scene, points).triangle);
    std::vector<int> count(scene.triangles.size());
    for (const std::int32_t triangle : four.triangle) ++count.at(static_cast<std::size_t>(triangle));
    EXPECT_EQ(count[0] + count[1], 0) << "never there";
    EXPECT_NEAR(count[2] + count[3], 2048, 5 * 32);
    EXPECT_NEAR(count[4] + count[5], 2048, 5 * 32);
    EXPECT_EQ(std::count(four.is_occluded.begin(), four.is_occluded.end(), true), 4096);
}

/// A mask of cells is a mesh of the same cells.
TEST(Alpha, CheckerboardIsGeometry) {
    constexpr int kCells = 8;
    scene::Scene masked;
    scene::Scene mesh;
    scene::Texture texture{.name = "checker", .width = kCells, .height = kCells, .texels = {}};
    texture.channels = 1;
    texture.filter = scene::TextureFilter::nearest;
    mesh.materials = {make_material(1, -1)};
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
            const bool is_there = (3 * x + 5 * y) % 7 < 3;
            texture.texels.push_back(is_there ? 1.0f : 0.0f);
            if (!is_there) continue;
            const auto at = [](int i, int j) { return Float3{i / float(kCells), j / float(kCells), 0}; };
            add_quad(mesh, {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)}, 0);
        }
    masked.textures = {texture};
    masked.materials = {make_material(1, 0)};
    add_unit_square(masked, 0, 0);

    std::vector<scene::Float2> points;
    for (const scene::Float2& p : random_points(1 << 14)) {
        // Not where rounding decides.
        const auto is_inside = [](float x) { return std::fabs(x * kCells - std::round(x * kCells)) > 1e-4f; };
        if (is_inside(p.x) && is_inside(p.y)) points.push_back(p);
    }
    const Answers expected = trace<8>(mesh, points);
    for (const scene::Scene& variant : {masked, as_instance(masked)}) {
        const Answers answers = trace<8>(variant, points);
        EXPECT_EQ(answers.is_occluded, expected.is_occluded);
        for (std::size_t i = 0; i < answers.triangle.size(); ++i)
            ASSERT_EQ(answers.triangle[i] >= 0, expected.triangle[i] >= 0)
                << points[i].x << " " << points[i].y;
    }
}

/// alpha_at() at the point (x, y) of the unit square.
float alpha_at(const scene::Scene& scene, float x, float y) {
    // The first triangle has the corners (0,0), (1,0), (1,1): barycentric coordinates go beyond it.
    return visibility::alpha_at(scene, 0, x - y, y);
}

TEST(Alpha, TexturesAreLookedUpAsDocumented) {
    scene::Scene scene;
    scene::Texture texture{.name = "ramp", .width = 4, .height = 2, .texels = {}};
    texture.channels = 3;
    const float red[] = {0.1f, 0.2f, 0.4f, 0.8f, 0.3f, 0.5f, 0.7f, 0.9f};
    for (const float value : red) texture.texels.insert(texture.texels.end(), {value, 0, 0});
    scene.textures = {texture};
    scene.materials = {make_material(0.5f, 0)};
    add_unit_square(scene, 0, 0);
    const auto expect = [&](float x, float y, double alpha) {
        EXPECT_NEAR(alpha_at(scene, x, y), 0.5 * alpha, 1e-6) << x << " " << y;
    };
    // Centres of texels, halfway between them along one axis and along both.
    expect(0.125f, 0.25f, 0.1);
    expect(0.875f, 0.75f, 0.9);
    expect(0.25f, 0.25f, 0.15);
    expect(0.375f, 0.5f, 0.35);
    expect(0.5f, 0.5f, (0.2 + 0.4 + 0.5 + 0.7) / 4);
    // Around the corner.
    expect(0, 0.25f, 0.45);
    expect(1, 0.25f, 0.45);
    expect(-1.875f, 2.25f, 0.1);
    expect(0.125f, 0, 0.2);
    scene.textures[0].wrap = scene::TextureWrap::clamp;
    expect(0, 0.25f, 0.1);
    expect(-7, 0.25f, 0.1);
    expect(1e20f, 0.25f, 0.8);
    expect(0.875f, 3, 0.9);
    scene.textures[0].wrap = scene::TextureWrap::black;
    expect(0, 0.25f, 0.05);
    expect(0.125f, 1, 0.15);
    expect(-0.25f, 0.25f, 0);
    expect(1e20f, 0.25f, 0);
    scene.textures[0].filter = scene::TextureFilter::nearest;
    expect(0.01f, 0.01f, 0.1);
    expect(0.99f, 0.49f, 0.8);
    expect(0.26f, 0.51f, 0.5);
    expect(1.01f, 0.1f, 0);
    // Scale and offset of texture coordinates; what overflows is the point 0.
    scene.materials[0].alpha_texture.scale = {2, 1};
    scene.materials[0].alpha_texture.offset = {0.25f, 0.5f};
    expect(0.01f, 0.01f, 0.5);
    expect(0.3f, 0.01f, 0.9);
    scene.materials[0].alpha_texture.scale = {std::numeric_limits<float>::infinity(), 1};
    expect(0.5f, 0.1f, 0.3);
}

/// The floor under the panel with a screen between them, which the camera does not see.
scene::Scene make_screen_scene(float alpha) {
    scene::Scene scene = make_floor(32);
    scene.materials.push_back(make_material(alpha, -1));
    scene.materials.push_back(make_material(1, -1));
    scene.materials.back().diffuse = {0, 0, 0};
    add_quad(scene,
             {Float3{-0.3f, -0.5f, 1.2f}, Float3{0.5f, -0.5f, 1.2f}, Float3{0.5f, 0.7f, 1.2f},
              Float3{-0.3f, 0.7f, 1.2f}},
             1);
    add_polygon_light(scene,
                      {Float3{-0.4f, -0.3f, 1.7f}, Float3{-0.4f, 0.5f, 1.9f}, Float3{0.6f, 0.5f, 1.9f},
                       Float3{0.6f, -0.3f, 1.7f}},
                      {5, 5, 5}, false, 2);
    return scene;
}

std::vector<std::vector<double>> screen_means(float alpha, render::Technique technique, int seeds) {
    const scene::Scene scene = make_screen_scene(alpha);
    const render_cpu::Renderer renderer(scene, 2);
    render::RenderSettings settings;
    settings.technique = technique;
    settings.samples = 16;
    return render_region_means(renderer, settings, seeds, renderer.visibility().tracer());
}

/// Each shadow ray crosses the screen at most once: the image is linear in alpha. The test detects another alpha.
TEST(Alpha, ShadowsAreLinearInIt) {
    const auto technique = render::Technique::projected_solid_angle;
    const auto mean = [](const std::vector<std::vector<double>>& rows) {
        std::vector<double> result(rows.at(0).size());
        for (const auto& row : rows)
            for (std::size_t i = 0; i < row.size(); ++i)
                result[i] += row[i] / static_cast<double>(rows.size());
        return result;
    };
    const std::vector<double> clear = mean(screen_means(0, technique, 256));
    const std::vector<double> opaque = mean(screen_means(1, technique, 256));
    const auto mixed = [&](double alpha) {
        std::vector<double> result;
        for (std::size_t i = 0; i < clear.size(); ++i)
            result.push_back((1 - alpha) * clear[i] + alpha * opaque[i]);
        return result;
    };
    const auto rows = screen_means(0.4f, technique, kSeeds);
    EXPECT_LT(largest_t(rows, mixed(0.4)), kLargestT);
    EXPECT_GT(largest_t(rows, mixed(0.42)), kLargestT);
}

/// Lights stay what they are where their surfaces are not there: only their own picture is missing.
TEST(Alpha, LightsWithoutSurfacesShine) {
    const scene::Scene with_surface = [] {
        scene::Scene scene = make_box_scene(64);
        scene.lights.of<scene::LineLight>().clear();
        return scene;
    }();
    scene::Scene invisible = with_surface;
    invisible.materials.push_back(make_material(0, -1));
    scene::Scene without = with_surface;
    for (std::size_t i = 0; i < with_surface.triangles.size(); ++i)
        if (with_surface.triangle_light[i] >= 0)
            invisible.triangle_material[i] = static_cast<std::uint32_t>(invisible.materials.size() - 1);
    without.triangles.resize(without.triangles.size() - 2);
    without.triangle_material.resize(without.triangles.size());
    without.triangle_light.resize(without.triangles.size());

    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    const auto render = [&](const scene::Scene& scene) {
        return render_cpu::Renderer(scene, 2).render(settings, base::choose_isa()).image;
    };
    const image::Image reference = render(with_surface);
    const image::Image image = render(invisible);
    EXPECT_EQ(image.pixels, render(without).pixels);
    // The light is a few pixels large, and shadows of its surface on the ceiling are missing too.
    const double share = differing_share(image, reference, 1e-6, 0);
    EXPECT_GT(share, 0);
    EXPECT_LT(share, 0.1);
}

/// Both sides of a light emit if it is two-sided.
TEST(Alpha, TwoSidedLightsShineUpwardsToo) {
    for (const bool two_sided : {false, true}) {
        scene::Scene scene = make_floor(32);
        scene.materials.push_back(make_material(0, -1));
        // Counter-clockwise from above.
        add_polygon_light(
            scene,
            {Float3{-0.4f, -0.3f, 1}, Float3{0.6f, -0.3f, 1}, Float3{0.6f, 0.5f, 1}, Float3{-0.4f, 0.5f, 1}},
            {5, 5, 5}, two_sided, 1);
        const auto image =
            render_cpu::Renderer(scene, 2).render(render::RenderSettings(), base::choose_isa()).image;
        double sum = 0;
        for (const float value : image.pixels) sum += value;
        EXPECT_EQ(sum > 0, two_sided);
    }
}

} // namespace
} // namespace nusselt::render_test
