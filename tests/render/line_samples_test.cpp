/// Line samples: the mean is that of point samples, whatever is chosen, and what must not matter does not.

#include "line_scenes.h"

#include "image/metrics.h"
#include "render/metadata.h"
#include "render_cpu/backend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace nusselt::render_test {
namespace {

using render::LightSamples;
using render::LineOffsets;
using render::LineOrientation;
using render::LineShading;
using render::ManyOccluders;
using render::RenderResult;
using render::RenderSettings;
using render::Technique;

/// Not seen from its axis: the centres of pixels would be on the edges between walls, where rounding decides whether a
/// wall hides the light from points of its neighbour.
scene::Scene make_box(int size) {
    scene::Scene scene = make_box_scene(size);
    set_camera(scene, {0.03f, -4, 1.02f}, {0, 0, 1}, {0, 0, 1}, 0.32, size, size);
    return scene;
}

std::string description_of(const RenderSettings& settings) {
    std::string text(name_of(settings.lines.orientation));
    for (const auto name : {name_of(settings.lines.offsets), name_of(settings.lines.shading),
                            name_of(settings.sample_order), name_of(settings.brdf)})
        text.append(", ").append(name);
    return text;
}

RenderResult render(const scene::Scene& scene, const RenderSettings& settings, int threads = 2) {
    return render_cpu::Renderer(scene, threads).render(settings, base::choose_isa());
}

class LineSamples : public testing::Test {
protected:
    LineSamples() : scene_(make_box(kSize)), renderer_(scene_, 2) {}

    std::vector<std::vector<double>> rows(const RenderSettings& settings) {
        return render_region_means(renderer_, settings, kSeeds, renderer_.visibility().tracer());
    }

    scene::Scene scene_;
    render_cpu::Renderer renderer_;
};

TEST_F(LineSamples, HaveTheMeanOfPoints) {
    const auto reference = rows(point_settings());
    for (const auto orientation : render::kLineOrientations)
        for (const auto offsets : render::kLineOffsets) {
            RenderSettings settings = line_settings(5);
            settings.lines.orientation = orientation;
            settings.lines.offsets = offsets;
            EXPECT_LT(largest_t(rows(settings), reference), kLargestT) << description_of(settings);
        }
    for (const auto order : render::kSampleOrders) {
        RenderSettings settings = line_settings(8);
        settings.sample_order = order;
        EXPECT_LT(largest_t(rows(settings), reference), kLargestT) << description_of(settings);
    }
}

TEST_F(LineSamples, HaveTheMeanOfPointsWithManyCameraRays) {
    RenderSettings points = point_settings();
    points.pixel_position = render::PixelPosition::jittered;
    points.camera_rays = kSamples;
    const auto reference = rows(points);
    for (const auto order : render::kSampleOrders) {
        RenderSettings settings = line_settings(1);
        settings.pixel_position = points.pixel_position;
        settings.camera_rays = kSamples;
        settings.sample_order = order;
        EXPECT_LT(largest_t(rows(settings), reference), kLargestT) << description_of(settings);
    }
}

/// The integral along a line is exact for matte surfaces.
TEST_F(LineSamples, AnalyticOnesHaveTheMeanOfPointsOnMatteSurfaces) {
    RenderSettings points = point_settings();
    points.brdf = render::BrdfChoice::lambert;
    RenderSettings settings = line_settings(4);
    settings.brdf = points.brdf;
    settings.lines.shading = LineShading::analytic;
    EXPECT_LT(largest_t(rows(settings), rows(points)), kLargestT);
}

/// The test of the tests: a panel that is 2 cm wider, or elsewhere.
TEST_F(LineSamples, RejectOtherLights) {
    const auto reference = rows(point_settings());
    for (const bool is_wider : {true, false}) {
        scene::Scene other = scene_;
        for (Float3& corner : other.lights.of<scene::PolygonLight>()[0].vertices)
            if (!is_wider || corner.x > 0) corner.x += 0.02f;
        const render_cpu::Renderer renderer(other, 2);
        const auto mutant =
            render_region_means(renderer, line_settings(8), kSeeds, renderer.visibility().tracer());
        EXPECT_GT(largest_t(mutant, reference), kLargestT) << is_wider;
    }
}

/// Ways to use lines that take other paths through the kernel.
std::vector<RenderSettings> varied_settings() {
    std::vector<RenderSettings> all(4, line_settings(6));
    all[1].lines.orientation = LineOrientation::independent;
    all[1].lines.offsets = LineOffsets::uniform;
    all[2].lines.shading = LineShading::analytic;
    all[2].lines.count = 100;
    all[3].lines.many_occluders = ManyOccluders::points;
    all[3].lines.count = 16;
    for (RenderSettings& settings : all) {
        settings.pixel_position = render::PixelPosition::jittered;
        settings.samples = 2;
        settings.camera_rays = 2;
    }
    return all;
}

TEST(LineInvariance, ThreadCountChangesNoBit) {
    const scene::Scene scene = make_box(2 * kSize);
    for (const RenderSettings& settings : varied_settings())
        EXPECT_EQ(render(scene, settings, 1).image.pixels, render(scene, settings, 5).image.pixels)
            << description_of(settings);
}

TEST(LineInvariance, CropsAndPartsAreThoseOfTheWholeImage) {
    scene::Scene scene = make_box(2 * kSize);
    for (RenderSettings settings : varied_settings()) {
        const image::Image whole = render(scene, settings).image;
        settings.part = {2, 3};
        const image::Image part = render(scene, settings).image;
        settings.part = {};
        std::size_t rendered = 0;
        for (std::size_t i = 0; i < part.pixels.size(); ++i) {
            if (part.pixels[i] == 0) continue;
            ASSERT_EQ(part.pixels[i], whole.pixels[i]) << description_of(settings);
            ++rendered;
        }
        EXPECT_GT(rendered, part.pixels.size() / 6);

        scene::Scene cropped = scene;
        cropped.film.crop = scene::PixelBounds{5, 9, 43, 60};
        const image::Image crop = render(cropped, settings).image;
        for (int y = 0; y < crop.height; ++y)
            for (int x = 0; x < 3 * crop.width; ++x)
                ASSERT_EQ(crop.pixels[static_cast<std::size_t>(3 * y * crop.width + x)],
                          whole.pixels[static_cast<std::size_t>(3 * (y + 9) * whole.width + 15 + x)])
                    << description_of(settings);
    }
}

TEST(LineInvariance, PowersOfTwoAsUnitOfLengthChangeNoBit) {
    const scene::Scene scene = make_box(2 * kSize);
    for (const RenderSettings& settings : varied_settings()) {
        const image::Image reference = render(scene, settings).image;
        for (const float factor : {0x1p-10f, 0x1p10f})
            EXPECT_EQ(reference.pixels, render(scaled(scene, factor), settings).image.pixels)
                << description_of(settings) << ", " << factor;
    }
}

TEST(LineInvariance, UnitOfLengthChangesNextToNothing) {
    const scene::Scene scene = make_box(2 * kSize);
    for (const RenderSettings& settings : varied_settings()) {
        const image::Image reference = render(scene, settings).image;
        for (const float factor : {1e-3f, 1e3f})
            EXPECT_LE(differing_share(render(scaled(scene, factor), settings).image, reference, 1e-3, 0),
                      2e-3)
                << description_of(settings) << ", " << factor;
    }
}

class LineIsaInvariance : public testing::TestWithParam<base::Isa> {};

TEST_P(LineIsaInvariance, HardlyAnyPixelDiffers) {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this processor does not support it";
    const scene::Scene scene = make_box(4 * kSize);
    const render_cpu::Renderer renderer(scene, 2);
    for (const RenderSettings& settings : varied_settings()) {
        const image::Image baseline = renderer.render(settings, base::Isa::sse42).image;
        EXPECT_LE(differing_share(renderer.render(settings, GetParam()).image, baseline, 1e-3, 0), 1e-3)
            << description_of(settings);
    }
}

INSTANTIATE_TEST_SUITE_P(AllIsas, LineIsaInvariance, testing::Values(base::Isa::avx2, base::Isa::avx512),
                         [](const auto& test) { return std::string(name_of(test.param)); });

/// The choice does not depend on random numbers, and it does not change the mean.
TEST(LineChoice, TakesPointsBehindManyOccluders) {
    const scene::Scene scene = make_soup(900);
    const render_cpu::Renderer renderer(scene, 2);
    const auto tracer = renderer.visibility().tracer();
    RenderSettings settings = line_settings(16);
    const auto statistics_of = [&] { return renderer.render(settings, base::choose_isa()).statistics.lines; };
    const render::LineStatistics lines_only = statistics_of();
    EXPECT_EQ(lines_only.point_lights, 0u);
    EXPECT_EQ(lines_only.lines, 16 * lines_only.line_lights);

    settings.lines.orientation = LineOrientation::fixed;
    settings.lines.many_occluders = ManyOccluders::points;
    const render::LineStatistics both = statistics_of();
    EXPECT_GT(both.point_lights, 0u);
    EXPECT_GT(both.line_lights, 0u);
    EXPECT_EQ(both.line_lights + both.point_lights, lines_only.line_lights);
    settings.seed = 77;
    EXPECT_EQ(statistics_of().point_lights, both.point_lights);
    const auto reference = render_region_means(renderer, point_settings(), kSeeds, tracer);
    EXPECT_LT(largest_t(render_region_means(renderer, settings, kSeeds, tracer), reference), kLargestT);
    settings.lines.many_occluders = ManyOccluders::lines;
    EXPECT_LT(largest_t(render_region_means(renderer, settings, kSeeds, tracer), reference), kLargestT);
}

TEST(LineChoice, TakesPointsInPlaceOfFewLines) {
    const scene::Scene scene = make_soup(0);
    RenderSettings settings = line_settings(15);
    settings.lines.many_occluders = ManyOccluders::points;
    EXPECT_EQ(render(scene, settings).statistics.lines.lines, 0u);
    settings.lines.count = 16;
    EXPECT_GT(render(scene, settings).statistics.lines.lines, 0u);
}

const std::vector<float>& pieces_of(const RenderResult& result) {
    EXPECT_EQ(result.layers.at(0).name, "pieces");
    return result.layers.at(0).data;
}

TEST(LinePieces, AreTheVisiblePartsPerLine) {
    scene::Scene scene = make_soup(0);
    RenderSettings settings = line_settings(16);
    settings.layers = {render::LayerKind::pieces};
    settings.lines.orientation = LineOrientation::fixed;
    const RenderResult open = render(scene, settings);
    const std::vector<float>& whole = pieces_of(open);
    for (std::size_t i = 0; i < whole.size(); ++i)
        ASSERT_EQ(whole[i], open.image.pixels[3 * i] > 0 && open.image.pixels[3 * i] < 5 ? 1 : 0) << i;

    // Across all lines, as seen from anywhere below; all edges of the panel are as long, the first one is along y.
    add_quad(scene,
             {Float3{-9, -0.01f, 0.99f}, Float3{9, -0.01f, 0.99f}, Float3{9, 0.01f, 0.99f},
              Float3{-9, 0.01f, 0.99f}},
             0);
    const RenderResult striped = render(scene, settings);
    const std::vector<float>& halves = pieces_of(striped);
    EXPECT_EQ(*std::max_element(halves.begin(), halves.end()), 2);
    EXPECT_GT(std::count(halves.begin(), halves.end(), 2.0f), kSize * kSize / 2);

    settings.light_samples = LightSamples::points;
    EXPECT_TRUE(render(scene, settings).layers.empty());
}

TEST(LineSurfaces, InstancesCastTheShadowsOfTheirTriangles) {
    const scene::Scene flat = make_soup(40);
    scene::Scene copied = flat;
    // The object is all that was added after floor and panel.
    copied.objects.push_back({"object", 4, static_cast<std::uint32_t>(flat.triangles.size()) - 4});
    copied.instances.push_back({});
    const RenderSettings settings = line_settings(8);
    EXPECT_LE(differing_share(render(copied, settings).image, render(flat, settings).image, 1e-3, 0), 2e-3);
}

/// Lines cannot decide whether a partially opaque surface hides them, but points can.
TEST(LineSurfaces, PointsGoThroughPartlyPresentOnes) {
    scene::Scene scene = make_soup(40);
    scene.materials.push_back({.name = "gauze", .diffuse = {0.5f, 0.5f, 0.5f}});
    scene.materials.back().alpha = 0.5f;
    for (std::size_t i = 44; i < scene.triangle_material.size(); ++i) scene.triangle_material[i] = 2;
    const render_cpu::Renderer renderer(scene, 2);
    const auto tracer = renderer.visibility().tracer();
    const RenderSettings settings = line_settings(4);
    const auto lines = renderer.render(settings, base::choose_isa()).statistics.lines;
    EXPECT_GT(lines.point_lights, 0u);
    EXPECT_GT(lines.line_lights, 0u);
    EXPECT_LT(largest_t(render_region_means(renderer, settings, kSeeds, tracer),
                        render_region_means(renderer, point_settings(), kSeeds, tracer)),
              kLargestT);
}

TEST(LineSurfaces, AreNotNeededWithoutPolygonalLights) {
    scene::Scene scene = make_floor(kSize);
    add_line_light(scene, "tube", {0, {0, 0, 1}, {1, 0, 1}, 0.01f, {9, 9, 9}, scene::TubeModel::linear});
    RenderSettings points = line_settings(4);
    points.light_samples = LightSamples::points;
    EXPECT_EQ(render(scene, line_settings(4)).image.pixels, render(scene, points).image.pixels);
}

TEST(LineSurfaces, ThatAreNotThereCastNoShadow) {
    scene::Scene scene = make_soup(40);
    const image::Image open = render(make_soup(0), line_settings(8)).image;
    scene.materials.push_back({.name = "nothing"});
    scene.materials.back().alpha = 0;
    for (std::size_t i = 4; i < scene.triangle_material.size(); ++i) scene.triangle_material[i] = 2;
    EXPECT_EQ(render(scene, line_settings(8)).image.pixels, open.pixels);
}

TEST(LineLights, MayBeMany) {
    constexpr int kSide = 316;
    scene::Scene scene = make_floor(4);
    for (int i = 0; i < kSide * kSide; ++i) {
        const float x = -0.5f + static_cast<float>(i % kSide) / kSide;
        const float y = -0.5f + static_cast<float>(i / kSide) / kSide;
        constexpr float kWidth = 1.0f / kSide;
        add_polygon_light(scene,
                          {Float3{x, y, 1}, Float3{x, y + kWidth, 1}, Float3{x + kWidth, y + kWidth, 1},
                           Float3{x + kWidth, y, 1}},
                          {5, 5, 5}, false, 0);
    }
    scene::Scene one = make_floor(4);
    add_polygon_light(
        one, {Float3{-0.5f, -0.5f, 1}, Float3{-0.5f, 0.5f, 1}, Float3{0.5f, 0.5f, 1}, Float3{0.5f, -0.5f, 1}},
        {5, 5, 5}, false, 0);
    const image::Image many = render(scene, line_settings(1)).image;
    const image::Image single = render(one, line_settings(256)).image;
    for (std::size_t i = 0; i < many.pixels.size(); ++i)
        EXPECT_NEAR(many.pixels[i], single.pixels[i], 1e-3 * single.pixels[i]) << i;
}

TEST(LineSettings, OutOfRangeAreRefused) {
    const scene::Scene scene = make_floor(2);
    const auto expect_refused = [&](const RenderSettings& settings) {
        EXPECT_THROW(render(scene, settings), std::invalid_argument);
    };
    expect_refused(line_settings(0));
    expect_refused(line_settings(render::kMaxLines + 1));
    RenderSettings settings = line_settings(1);
    settings.technique = Technique::ltc_analytic;
    expect_refused(settings);
    settings = line_settings(render::kMaxLines);
    settings.samples = render::kMaxSamples;
    settings.camera_rays = render::kMaxSamples;
    expect_refused(settings);
}

/// Checkpoints and images to merge belong to one rendering if their metadata agree.
TEST(LineSettings, AreInTheMetadata) {
    const scene::Scene scene = make_floor(2);
    const auto metadata_of = [&](const RenderSettings& settings) {
        return render::make_metadata(scene, settings, render_cpu::CpuBackend(base::choose_isa(), 1));
    };
    const RenderSettings settings = line_settings(4);
    std::vector<RenderSettings> others(6, settings);
    others[0].light_samples = LightSamples::points;
    others[1].lines.count = 5;
    others[2].lines.orientation = LineOrientation::fixed;
    others[3].lines.offsets = LineOffsets::uniform;
    others[4].lines.shading = LineShading::analytic;
    others[5].lines.many_occluders = ManyOccluders::points;
    for (const RenderSettings& other : others)
        EXPECT_NE(metadata_of(other), metadata_of(settings)) << description_of(other);
    others[0].lines.count = 5;
    EXPECT_EQ(metadata_of(others[0]).count("lines"), 0u);
}

} // namespace
} // namespace nusselt::render_test
