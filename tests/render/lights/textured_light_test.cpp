/// Lights that emit an image: the radiance that cameras see and surfaces reflect, whichever technique samples them.

#include "lossy_tracer.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace nusselt::render_test {
namespace {

using render::EmissionSampling;
using render::Technique;

constexpr int kSize = 32;
constexpr int kFloorSize = 8;
constexpr int kColumns = 24;
constexpr int kRows = 16;
constexpr float kTexelScale = 3; ///< radiance of a texel of 1

const std::array<Float3, 4> kPanel = {Float3{-0.4f, -0.3f, 0.7f}, Float3{-0.4f, 0.5f, 0.9f},
                                      Float3{0.6f, 0.5f, 0.9f}, Float3{0.6f, -0.3f, 0.7f}};
const std::array<scene::Float2, 4> kCoordinates = {scene::Float2{0.1f, 0.9f}, scene::Float2{0.1f, 0.05f},
                                                   scene::Float2{1, 0.05f}, scene::Float2{1, 0.9f}};

/// Dark texels with some colour, and a few that are a hundred times brighter.
scene::EmissionTexture make_texture() {
    scene::EmissionTexture texture{"texture", kColumns, kRows, {}};
    std::uint32_t state = 5;
    const auto random = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / 16777216.0f;
    };
    for (int i = 0; i < kColumns * kRows; ++i) {
        const float brightness = random() < 0.03f ? 20.0f : 0.2f * random();
        texture.texels.push_back({brightness * random(), brightness, brightness * random()});
    }
    return texture;
}

/// Gives the last polygon a texture. \param mean over the light, or anything if nobody asks for the mean
void set_texture(scene::Scene& scene, const scene::EmissionTexture& texture, const Float3& mean) {
    scene::TexturedEmission emission;
    emission.texture = std::make_shared<const scene::EmissionTexture>(texture);
    std::copy(kCoordinates.begin(), kCoordinates.end(), emission.coordinates.begin());
    emission.mean = mean;
    scene::PolygonLight& light = scene.lights.of<scene::PolygonLight>().back();
    light.texture = static_cast<std::int32_t>(scene.emission_textures.size());
    light.radiance = {kTexelScale * mean.x, kTexelScale * mean.y, kTexelScale * mean.z};
    scene.emission_textures.push_back(emission);
}

/// The radiance at texture coordinates.
double radiance_at(const scene::EmissionTexture& texture, double u, double v, float Float3::*channel) {
    const double x = u * texture.width - 0.5;
    const double y = v * texture.height - 0.5;
    const auto texel = [&](double i, double j) {
        const auto column = static_cast<int>(std::min(std::max(i, 0.0), texture.width - 1.0));
        const auto row = static_cast<int>(std::min(std::max(j, 0.0), texture.height - 1.0));
        return double{texture.texels[static_cast<std::size_t>(row * texture.width + column)].*channel};
    };
    const double i = std::floor(x), j = std::floor(y);
    return kTexelScale * ((1 + j - y) * ((1 + i - x) * texel(i, j) + (x - i) * texel(i + 1, j)) +
                          (y - j) * ((1 + i - x) * texel(i, j + 1) + (x - i) * texel(i + 1, j + 1)));
}

/// The point of the panel with texture coordinates (u, v).
Float3 point_of_panel(double u, double v) {
    const double s = (u - 0.1) / 0.9;
    const double t = (0.9 - v) / 0.85;
    const auto at = [&](float Float3::*axis) {
        return static_cast<float>(kPanel[0].*axis + s * (kPanel[3].*axis - kPanel[0].*axis) +
                                  t * (kPanel[1].*axis - kPanel[0].*axis));
    };
    return {at(&Float3::x), at(&Float3::y), at(&Float3::z)};
}

/// A floor below the panel with the texture, seen from a side.
scene::Scene make_floor_scene(const scene::EmissionTexture& texture) {
    scene::Scene scene = make_floor(kSize);
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add_polygon_light(scene, kPanel, {1, 1, 1}, false, 1);
    set_texture(scene, texture, {0.3f, 0.5f, 0.3f});
    return scene;
}

/// The light that the floor reflects at a point, by the midpoint rule.
double floor_radiance(const scene::EmissionTexture& texture, double x, double y, float Float3::*channel) {
    constexpr int kPoints = 256;
    const Float3 a = {kPanel[1].x - kPanel[0].x, kPanel[1].y - kPanel[0].y, kPanel[1].z - kPanel[0].z};
    const Float3 b = {kPanel[3].x - kPanel[0].x, kPanel[3].y - kPanel[0].y, kPanel[3].z - kPanel[0].z};
    const double normal[3] = {double{a.y} * b.z - double{a.z} * b.y, double{a.z} * b.x - double{a.x} * b.z,
                              double{a.x} * b.y - double{a.y} * b.x};
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) {
        for (int j = 0; j < kPoints; ++j) {
            const double u = 0.1 + 0.9 * (i + 0.5) / kPoints;
            const double v = 0.05 + 0.85 * (j + 0.5) / kPoints;
            const Float3 p = point_of_panel(u, v);
            const double d[3] = {p.x - x, p.y - y, p.z};
            const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            const double facing = std::fabs(d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2]);
            sum += radiance_at(texture, u, v, channel) * d[2] * facing / (squared * squared);
        }
    }
    return kFloorAlbedo / 3.14159265358979 * sum / (kPoints * kPoints);
}

class TexturedLight : public testing::Test {
protected:
    TexturedLight() {
        settings_.samples = 16;
        settings_.camera_rays = 1;
        settings_.pixel_position = render::PixelPosition::center;
    }

    render::RenderSettings settings_;
};

/// The mean over pixels and seeds of the light that the floor reflects, and its standard error.
struct Floor {
    double mean = 0, error = 0;
};

Floor render_floor(const scene::Scene& scene, const render::RenderSettings& settings) {
    const render_cpu::Renderer renderer(scene, 2);
    std::vector<double> means;
    for (const auto& row : render_region_means(renderer, settings, kSeeds, renderer.visibility().tracer())) {
        double sum = 0;
        for (const double value : row) sum += value / static_cast<double>(row.size());
        means.push_back(sum);
    }
    Floor floor;
    for (const double mean : means) floor.mean += mean / kSeeds;
    for (const double mean : means)
        floor.error += (mean - floor.mean) * (mean - floor.mean) / (kSeeds * (kSeeds - 1.0));
    floor.error = std::sqrt(floor.error);
    return floor;
}

/// The mean over channels and pixels, each at the point of the floor that its centre sees.
double expected_floor(const scene::Scene& scene, const scene::EmissionTexture& texture) {
    double sum = 0;
    const scene::Camera& camera = scene.camera;
    for (int j = 0; j < kFloorSize; ++j) {
        for (int i = 0; i < kFloorSize; ++i) {
            const auto at = [&](float Float3::*axis) {
                return camera.corner.*axis + (i + 0.5) * camera.right.*axis + (j + 0.5) * camera.down.*axis;
            };
            const double t = -camera.origin.z / at(&Float3::z);
            const double x = camera.origin.x + t * at(&Float3::x);
            const double y = camera.origin.y + t * at(&Float3::y);
            for (const auto channel : {&Float3::x, &Float3::y, &Float3::z})
                sum += floor_radiance(texture, x, y, channel) / (3.0 * kFloorSize * kFloorSize);
        }
    }
    return sum;
}

/// The floor alone: the panel is above the camera's view.
scene::Scene make_small_floor(const scene::EmissionTexture& texture) {
    scene::Scene scene = make_floor_scene(texture);
    set_camera(scene, {0, -0.2f, 0.6f}, {0, 0, 0}, {0, 1, 0}, 0.5, kFloorSize, kFloorSize);
    return scene;
}

TEST_F(TexturedLight, LightsTheFloorLikeQuadrature) {
    const scene::EmissionTexture texture = make_texture();
    const scene::Scene scene = make_small_floor(texture);
    const double expected = expected_floor(scene, texture);
    settings_.samples = 64;
    const auto agrees = [&](const Floor& floor) {
        return std::fabs(floor.mean - expected) < kLargestT * floor.error + 2e-4 * expected;
    };
    settings_.emission_sampling = EmissionSampling::measure;
    EXPECT_TRUE(agrees(render_floor(scene, settings_)));
    settings_.emission_sampling = EmissionSampling::product;
    const Floor product = render_floor(scene, settings_);
    EXPECT_TRUE(agrees(product)) << product.mean << " +- " << product.error << ", expected " << expected;
    EXPECT_LT(product.error, 0.004 * expected);
    // The test of the test: a texture that is shifted by one texel.
    scene::EmissionTexture shifted = texture;
    std::rotate(shifted.texels.begin(), shifted.texels.begin() + 1, shifted.texels.end());
    EXPECT_FALSE(agrees(render_floor(make_small_floor(shifted), settings_)));
}

class TexturedBox : public TexturedLight {
protected:
    static scene::Scene make_scene(const scene::EmissionTexture& texture) {
        scene::Scene scene = make_box_scene(kSize);
        scene::PolygonLight& light = scene.lights.of<scene::PolygonLight>().back();
        EXPECT_EQ(light.vertices.size(), 4u);
        set_texture(scene, texture, {0.3f, 0.5f, 0.3f});
        return scene;
    }

    std::vector<std::vector<double>> rows(const render_cpu::Renderer& renderer,
                                          const visibility::RayTracer& tracer) const {
        return render_region_means(renderer, settings_, kSeeds, tracer);
    }
};

TEST_F(TexturedBox, AllWaysToSampleHaveTheSameExpectation) {
    const scene::Scene scene = make_scene(make_texture());
    const render_cpu::Renderer renderer(scene, 2);
    const auto tracer = renderer.visibility().tracer();
    settings_.technique = Technique::area;
    settings_.samples = 64;
    const auto reference = rows(renderer, tracer);
    settings_.samples = 16;
    settings_.technique = Technique::projected_solid_angle;
    EXPECT_LT(largest_t(rows(renderer, tracer), reference), kLargestT);
    settings_.strategies = render::Strategies::diffuse_ltc;
    for (const auto mis : render::kMisHeuristics) {
        settings_.mis = mis;
        EXPECT_LT(largest_t(rows(renderer, tracer), reference), kLargestT) << render::name_of(mis);
    }
    const LossyTracer mutant(tracer, 0.03);
    EXPECT_GT(largest_t(rows(renderer, mutant.tracer()), reference), kLargestT);
    const scene::EmissionTexture texture = make_texture();
    scene::EmissionTexture shifted = texture;
    std::rotate(shifted.texels.begin(), shifted.texels.begin() + 1, shifted.texels.end());
    const scene::Scene other_scene = make_scene(shifted);
    const render_cpu::Renderer other(other_scene, 2);
    EXPECT_GT(largest_t(rows(other, other.visibility().tracer()), reference), kLargestT);
}

TEST_F(TexturedBox, LineSamplesHaveTheMeanOfPoints) {
    const scene::Scene scene = make_scene(make_texture());
    const render_cpu::Renderer renderer(scene, 2);
    const auto tracer = renderer.visibility().tracer();
    settings_.samples = 32;
    const auto reference = rows(renderer, tracer);
    settings_.samples = 1;
    settings_.light_samples = render::LightSamples::lines;
    // Seeds depend on it: the reference has another one.
    settings_.technique = Technique::solid_angle;
    settings_.lines.count = 4;
    settings_.lines.many_occluders = render::ManyOccluders::lines;
    for (const auto orientation : render::kLineOrientations) {
        settings_.lines.orientation = orientation;
        EXPECT_LT(largest_t(rows(renderer, tracer), reference), kLargestT) << render::name_of(orientation);
    }
    settings_.lines.offsets = render::LineOffsets::reflected;
    EXPECT_LT(largest_t(rows(renderer, tracer), reference), kLargestT);
    // The mean radiance in place of the texture.
    scene::Scene mutant_scene = scene;
    mutant_scene.lights.of<scene::PolygonLight>().back().texture = -1;
    const render_cpu::Renderer mutant(mutant_scene, 2);
    EXPECT_GT(largest_t(rows(mutant, mutant.visibility().tracer()), reference), kLargestT);
}

TEST_F(TexturedLight, CamerasSeeTheTexels) {
    const scene::EmissionTexture texture = make_texture();
    scene::Scene scene = make_floor_scene(texture);
    for (const auto& [u, v] : {std::pair(0.15, 0.1), std::pair(0.5, 0.5), std::pair(0.93, 0.8)}) {
        const Float3 p = point_of_panel(u, v);
        set_camera(scene, {0.1f, -0.1f, 0.2f}, p, {0, 1, 0}, 1e-4, 1, 1);
        const render_cpu::Renderer renderer(scene, 1);
        settings_.samples = 1;
        const image::Image image = renderer.render(settings_, base::choose_isa()).image;
        EXPECT_NEAR(image.pixels[0], radiance_at(texture, u, v, &Float3::x), 2e-3) << u << " " << v;
        EXPECT_NEAR(image.pixels[1], radiance_at(texture, u, v, &Float3::y), 2e-3) << u << " " << v;
        EXPECT_NEAR(image.pixels[2], radiance_at(texture, u, v, &Float3::z), 2e-3) << u << " " << v;
    }
}

TEST_F(TexturedLight, ProductsHaveLessNoise) {
    const scene::Scene scene = make_small_floor(make_texture());
    settings_.samples = 1;
    settings_.sample_order = render::SampleOrder::independent;
    settings_.emission_sampling = EmissionSampling::measure;
    const double measure = render_floor(scene, settings_).error;
    settings_.emission_sampling = EmissionSampling::product;
    EXPECT_LT(render_floor(scene, settings_).error, 0.25 * measure);
}

TEST_F(TexturedLight, BlackTexturesAndChannelsAreBlack) {
    scene::EmissionTexture texture = make_texture();
    for (Float3& texel : texture.texels) texel.x = 0;
    for (const auto sampling : render::kEmissionSamplings) {
        settings_.emission_sampling = sampling;
        scene::Scene scene = make_small_floor(texture);
        scene.emission_textures[0].mean.x = 0;
        const image::Image image = render_cpu::Renderer(scene, 1).render(settings_, base::choose_isa()).image;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
            EXPECT_EQ(image.pixels[i], 0);
            EXPECT_GT(image.pixels[i + 1], 0);
        }
        scene::EmissionTexture black = texture;
        for (Float3& texel : black.texels) texel = {0, 0, 0};
        scene = make_small_floor(black);
        scene.emission_textures[0].mean = {0, 0, 0};
        for (const float value :
             render_cpu::Renderer(scene, 1).render(settings_, base::choose_isa()).image.pixels)
            EXPECT_EQ(value, 0);
    }
}

/// Closed forms know the mean of each cell.
TEST_F(TexturedLight, AnalyticShadingIsCloseToSamples) {
    const scene::EmissionTexture texture = make_texture();
    const scene::Scene scene = make_small_floor(texture);
    settings_.technique = Technique::ltc_analytic;
    const Floor analytic = render_floor(scene, settings_);
    EXPECT_NEAR(analytic.mean, expected_floor(scene, texture), 0.03 * analytic.mean);
}

} // namespace
} // namespace nusselt::render_test
