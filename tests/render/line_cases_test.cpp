/// Line samples where it is easy to lose light, or to depend on what must not matter.

#include "line_scenes.h"
#include "render/choices/line_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace nusselt::render_test {
namespace {

using render::LineOrientation;
using render::ManyOccluders;
using render::RenderResult;
using render::RenderSettings;

constexpr float kSlatShare = 0.16f; ///< of each period

/// A panel at z = 1 behind black slats, across those of its edges that fixed lines are parallel to.
/// \param count of the slats between any point of the floor and the panel
scene::Scene make_slats(int count, int size) {
    scene::Scene scene = make_soup(0, size);
    constexpr float kHeight = 0.9f;
    const float period = kHeight / static_cast<float>(count);
    for (float y = -1; y < 1; y += period) {
        const float end = y + kSlatShare * period;
        add_quad(scene,
                 {Float3{-9, y, kHeight}, Float3{9, y, kHeight}, Float3{9, end, kHeight},
                  Float3{-9, end, kHeight}},
                 1);
    }
    return scene;
}

/// Between slats as many parts are visible, however few there is room for.
TEST(LineParts, NoneIsLost) {
    constexpr int kImage = 4;
    for (const base::Isa isa : base::kAllIsas) {
        if (!is_supported(isa)) continue;
        RenderSettings settings = line_settings(16);
        settings.lines.orientation = LineOrientation::fixed;
        const auto image_of = [&](const scene::Scene& scene) {
            return render_cpu::Renderer(scene, 2).render(settings, isa).image;
        };
        const image::Image open = image_of(make_soup(0, kImage));
        for (const int count : {200, 3000}) {
            const image::Image slats = image_of(make_slats(count, kImage));
            int shading_points = 0;
            for (std::size_t i = 0; i < open.pixels.size(); ++i) {
                if (open.pixels[i] == 0 || open.pixels[i] == 5) continue;
                ++shading_points;
                EXPECT_NEAR(slats.pixels[i] / open.pixels[i], 1 - kSlatShare, 5e-3)
                    << name_of(isa) << ", " << count << " slats, " << i;
            }
            EXPECT_GE(shading_points, 3 * kImage);
        }
    }
}

/// Points on parts of lines correct the fitted lobes.
TEST(LineParts, HaveTheMeanOfPointsOnGlossySurfaces) {
    constexpr int kImage = kRegionsPerAxis;
    scene::Scene scene = make_slats(800, kImage);
    scene.materials[0].model = scene::BrdfModel::frostbite;
    scene.materials[0].f0 = {0.2f, 0.2f, 0.2f};
    scene.materials[0].roughness = 0.5f;
    const render_cpu::Renderer renderer(scene, 2);
    const auto tracer = renderer.visibility().tracer();
    RenderSettings settings = line_settings(4);
    EXPECT_LT(largest_t(render_region_means(renderer, settings, kSeeds, tracer),
                        render_region_means(renderer, point_settings(), kSeeds, tracer)),
              kLargestT);
}

/// Changes the material of all triangles but those of floor and panel to one that is partly there.
void make_gauze(scene::Scene& scene) {
    scene.materials.push_back({.name = "gauze", .diffuse = {0, 0, 0}});
    scene.materials.back().alpha = 0.5f;
    for (std::size_t i = 4; i < scene.triangle_material.size(); ++i) scene.triangle_material[i] = 2;
}

/// Random orientations in particular.
TEST(LineOrPoints, DoesNotDependOnRandomNumbers) {
    for (const bool is_gauze : {false, true}) {
        scene::Scene scene = make_soup(is_gauze ? 40 : 900);
        if (is_gauze) make_gauze(scene);
        const render_cpu::Renderer renderer(scene, 2);
        for (const auto orientation : render::kLineOrientations) {
            RenderSettings settings = line_settings(16);
            settings.lines.orientation = orientation;
            settings.lines.many_occluders = is_gauze ? ManyOccluders::lines : ManyOccluders::points;
            settings.seed = 1;
            const auto count = [&] { return renderer.render(settings, base::choose_isa()).statistics.lines; };
            const auto count_points = [&] { return count().point_lights; };
            const std::uint64_t expected = count_points();
            EXPECT_GT(expected, 0u) << "points somewhere";
            EXPECT_GT(count().lines, 0u) << "lines elsewhere";
            for (settings.seed = 2; settings.seed <= 8; ++settings.seed)
                EXPECT_EQ(count_points(), expected) << name_of(orientation) << ", " << settings.seed;
        }
    }
}

/// Both in one image, and several camera rays for each.
TEST(LineOrPoints, HaveTheMeanOfPointsWithManyCameraRays) {
    scene::Scene scene = make_soup(40);
    make_gauze(scene);
    const render_cpu::Renderer renderer(scene, 2);
    const auto tracer = renderer.visibility().tracer();
    RenderSettings points = point_settings();
    points.pixel_position = render::PixelPosition::jittered;
    points.camera_rays = 4;
    const auto reference = render_region_means(renderer, points, kSeeds, tracer);
    for (const auto order : render::kSampleOrders)
        for (const auto orientation : {LineOrientation::parallel, LineOrientation::independent}) {
            RenderSettings settings = line_settings(5);
            settings.pixel_position = points.pixel_position;
            settings.camera_rays = points.camera_rays;
            settings.sample_order = order;
            settings.lines.orientation = orientation;
            EXPECT_LT(largest_t(render_region_means(renderer, settings, kSeeds, tracer), reference),
                      kLargestT)
                << name_of(order) << ", " << name_of(orientation);
        }
}

TEST(LineOrPoints, TakesMoreOccludersForMoreLines) {
    EXPECT_EQ(render::most_occluders_for_lines(15), -1);
    EXPECT_EQ(render::most_occluders_for_lines(16), 24);
    EXPECT_EQ(render::most_occluders_for_lines(32), 96);
}

/// Stratified samples are made for 2^22 of a pixel.
TEST(LineOrPoints, TakesNoMorePointsThanThereAreRandomNumbersFor) {
    EXPECT_EQ(render::points_in_place_of_lines(1, 1), 1);
    EXPECT_EQ(render::points_in_place_of_lines(16, 1), 64);
    EXPECT_EQ(render::points_in_place_of_lines(16, 1 << 10), 64);
    EXPECT_EQ(render::points_in_place_of_lines(render::kMaxLines, 1), render::kMaxSamples);
    EXPECT_EQ(render::points_in_place_of_lines(render::kMaxLines, 1 << 12), 1 << 10);
    EXPECT_EQ(render::points_in_place_of_lines(1 << 11, render::kMaxSamples), 4);
}

/// A regular polygon that faces the floor, with a triangle in front.
scene::Scene make_polygon_light(int vertices, bool two_sided) {
    scene::Scene scene = make_floor(kSize);
    scene::PolygonLight light;
    scene.emitters.push_back({"polygon"});
    light.radiance = {5, 5, 5};
    light.two_sided = two_sided;
    for (int i = 0; i < vertices; ++i) {
        const double angle = -2 * 3.14159265358979 * (i + 0.3) / vertices;
        light.vertices.push_back(
            {static_cast<float>(0.5 * std::cos(angle)), static_cast<float>(0.4 * std::sin(angle)), 1});
    }
    scene.lights.of<scene::PolygonLight>().push_back(light);
    for (std::size_t i = 2; i < light.vertices.size(); ++i)
        add_quad(scene, {light.vertices[0], light.vertices[i - 1], light.vertices[i], light.vertices[i]}, 0,
                 0);
    add_quad(
        scene,
        {Float3{-0.2f, -0.3f, 0.5f}, Float3{0.3f, 0.1f, 0.6f}, Float3{0, 0.3f, 0.4f}, Float3{0, 0.3f, 0.4f}},
        0);
    // Above the light: what only a two-sided one lights.
    add_quad(scene, {Float3{-1, 0.5f, 0.8f}, Float3{1, 0.5f, 0.8f}, Float3{1, 1, 1.8f}, Float3{-1, 1, 1.8f}},
             0);
    set_camera(scene, {0.1f, -2.5f, 1.2f}, {0.1f, 0, 0.6f}, {0, 0, 1}, 0.4, kSize, kSize);
    set_radius(scene);
    return scene;
}

TEST(LinePolygons, OfAnyNumberOfVerticesHaveTheMeanOfPoints) {
    for (const bool two_sided : {false, true})
        for (int vertices = 3; vertices <= 8; ++vertices) {
            const scene::Scene scene = make_polygon_light(vertices, two_sided);
            const render_cpu::Renderer renderer(scene, 2);
            const auto tracer = renderer.visibility().tracer();
            EXPECT_LT(largest_t(render_region_means(renderer, line_settings(4), kSeeds, tracer),
                                render_region_means(renderer, point_settings(), kSeeds, tracer)),
                      kLargestT)
                << vertices << " vertices, " << (two_sided ? "two sides" : "one side");
        }
}

/// The same holds for points, see hostile_scenes_test.cpp.
TEST(LineRejections, AreCounted) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    const auto rejected = [&](const scene::Scene& scene) {
        return render_cpu::Renderer(scene, 2)
            .render(line_settings(4), base::choose_isa())
            .statistics.rejected_samples;
    };
    EXPECT_EQ(rejected(make_soup(4)), 0u);
    scene::Scene light = make_soup(4);
    light.lights.of<scene::PolygonLight>()[0].vertices[0].x = kNaN;
    EXPECT_GT(rejected(light), 0u);
}

} // namespace
} // namespace nusselt::render_test
