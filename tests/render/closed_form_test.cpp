/// Unoccluded lights above a matte floor, where the radiance of each pixel has a closed form.

#include "lossy_tracer.h"
#include "scenes.h"

#include <nusselt/geometry/polygon_measures.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace nusselt::render_test {
namespace {

using render::Technique;

constexpr int kSize = 40;
constexpr float kRadiance = 5;

/// All of the floor that the camera sees lies in front of it.
const std::array<Float3, 4> kPanel = {Float3{-0.4f, -0.3f, 0.7f}, Float3{-0.4f, 0.5f, 0.9f},
                                      Float3{0.6f, 0.5f, 0.9f}, Float3{0.6f, -0.3f, 0.7f}};

scene::Scene make_panel_scene() {
    scene::Scene scene = make_floor(kSize);
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add_polygon_light(scene, kPanel, {kRadiance, kRadiance, kRadiance}, false, 1);
    return scene;
}

scene::LineLight make_tube() {
    return {.start = {-0.5f, -0.3f, 0.3f},
            .end = {0.6f, 0.4f, 0.8f},
            .radius = 0.01f,
            .radiance = {kRadiance, kRadiance, kRadiance},
            .model = scene::TubeModel::linear};
}

scene::Scene make_tube_scene() {
    scene::Scene scene = make_floor(kSize);
    add_line_light(scene, "tube", make_tube());
    return scene;
}

Vec3<double> to_vec(const Float3& v) { return {v.x, v.y, v.z}; }

/// Radiance of a pixel whose camera ray hits the floor at a point, and which sees no light.
using FloorRadiance = std::function<double(const Vec3<double>& point)>;

double panel_radiance(const Vec3<double>& point) {
    Vec3<double> vertices[4];
    for (std::size_t j = 0; j < 4; ++j) vertices[j] = to_vec(kPanel[j]) - point;
    const double psa = projected_solid_angle(make_polygon<4>(vertices, 4));
    return kFloorAlbedo / kPi<double> * kRadiance * psa;
}

/// Integral of 2 R cos_i sin_l / r^2 along the tube: Simpson's rule, far finer than the tests need.
double tube_radiance(const Vec3<double>& point) {
    const scene::LineLight tube = make_tube();
    const Vec3<double> extent = to_vec(tube.end) - to_vec(tube.start);
    const double tube_length = std::sqrt(dot(extent, extent));
    const auto integrand = [&](double t) {
        const Vec3<double> d = to_vec(tube.start) + t * extent - point;
        const double r2 = dot(d, d);
        const Vec3<double> n = cross(d, extent);
        const double sine = std::sqrt(dot(n, n) / (r2 * dot(extent, extent)));
        return d.z / std::sqrt(r2) * sine / r2;
    };
    constexpr int kIntervals = 2000;
    double sum = integrand(0) + integrand(1);
    for (int i = 1; i < kIntervals; ++i) sum += (i % 2 == 1 ? 4 : 2) * integrand(i / double(kIntervals));
    const double psa_per_radius = 2 * tube_length * sum / (3 * kIntervals);
    return kFloorAlbedo / kPi<double> * kRadiance * tube.radius * psa_per_radius;
}

/// The closed form for each pixel that sees the floor through its centre; NaN elsewhere.
std::vector<double> reference(const scene::Scene& scene, const image::Image& seen_lights,
                              const FloorRadiance& floor_radiance) {
    std::vector<double> result;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const auto& camera = scene.camera;
            const Vec3<double> direction =
                to_vec(camera.corner) + (x + 0.5) * to_vec(camera.right) + (y + 0.5) * to_vec(camera.down);
            const Vec3<double> eye = to_vec(camera.origin);
            const Vec3<double> point = eye + (-eye.z / direction.z) * direction;
            const bool on_floor = direction.z < 0 && std::fabs(point.x) < 4 && std::fabs(point.y) < 4 &&
                                  seen_lights.pixels[3 * static_cast<std::size_t>(y * kSize + x)] == 0;
            result.push_back(on_floor ? floor_radiance(point) : std::nan(""));
        }
    return result;
}

struct Case {
    const char* name;
    scene::Scene (*make_scene)();
    FloorRadiance floor_radiance;
};

class ClosedForm : public testing::TestWithParam<Case> {
protected:
    ClosedForm() : scene_(GetParam().make_scene()), renderer_(scene_, 2) {
        settings_.pixel_position = render::PixelPosition::center;
        settings_.samples = 4;
        expected_ = reference(scene_, lights_only(), GetParam().floor_radiance);
    }

    /// The scene with black surfaces: what remains are directly visible lights.
    image::Image lights_only() const {
        scene::Scene black = scene_;
        for (scene::Material& material : black.materials) material.diffuse = {0, 0, 0};
        return render_cpu::Renderer(black, 2).render(settings_, base::choose_isa()).image;
    }

    /// Ratios of pixels to their closed forms, averaged over groups of neighbours, for each seed.
    std::vector<std::vector<double>> ratio_rows(Technique technique, const visibility::RayTracer& tracer) {
        std::vector<std::vector<double>> rows;
        settings_.technique = technique;
        for (int seed = 0; seed < kSeeds; ++seed) {
            settings_.seed = static_cast<std::uint32_t>(seed);
            const auto result = renderer_.render(settings_, base::choose_isa(), tracer);
            EXPECT_EQ(result.statistics.rejected_samples, 0u) << render::name_of(technique);
            rows.push_back(mean_ratios(result.image));
        }
        return rows;
    }

    std::vector<double> mean_ratios(const image::Image& image) const {
        constexpr std::size_t kPixelsPerMean = 40;
        std::vector<double> means;
        double sum = 0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < expected_.size(); ++i) {
            if (std::isnan(expected_[i])) continue;
            sum += image.pixels[3 * i] / expected_[i] / kPixelsPerMean;
            if (++count % kPixelsPerMean != 0) continue;
            means.push_back(sum);
            sum = 0;
        }
        return means;
    }

    double largest_t_of(Technique technique, const visibility::RayTracer& tracer) {
        const auto rows = ratio_rows(technique, tracer);
        return largest_t(rows, std::vector<double>(rows.at(0).size(), 1.0));
    }

    scene::Scene scene_;
    render_cpu::Renderer renderer_;
    render::RenderSettings settings_;
    std::vector<double> expected_;
};

TEST_P(ClosedForm, EachTechniqueConverges) {
    for (const Technique technique : render::kTechniques) {
        if (technique == Technique::projected_solid_angle_biased) continue;
        EXPECT_LT(largest_t_of(technique, renderer_.visibility().tracer()), kLargestT)
            << render::name_of(technique);
    }
}

/// Without shadows, the density of projected solid angle sampling cancels everything: one sample suffices.
TEST_P(ClosedForm, ProjectedSolidAngleHasNoVariance) {
    settings_.samples = 1;
    settings_.technique = Technique::projected_solid_angle;
    const image::Image image = renderer_.render(settings_, base::choose_isa()).image;
    double squares = 0;
    double sum = 0;
    double count = 0;
    double worst = 0;
    for (std::size_t i = 0; i < expected_.size(); ++i) {
        if (std::isnan(expected_[i])) continue;
        const double error = image.pixels[3 * i] - expected_[i];
        squares += error * error;
        sum += expected_[i];
        count += 1;
        worst = std::max(worst, std::fabs(error) / expected_[i]);
    }
    ASSERT_GT(count, kSize * kSize / 2);
    EXPECT_LT(std::sqrt(squares / count), 2e-6 * sum / count);
    EXPECT_LT(worst, 1e-4);
}

/// Along each line the integral is exact: what is left is how it changes from line to line.
TEST_P(ClosedForm, ManyLinesHaveNextToNoVariance) {
    settings_.samples = 1;
    settings_.light_samples = render::LightSamples::lines;
    settings_.lines.count = 1024;
    for (const auto offsets : render::kLineOffsets) {
        settings_.lines.offsets = offsets;
        const image::Image image = renderer_.render(settings_, base::choose_isa()).image;
        for (std::size_t i = 0; i < expected_.size(); ++i) {
            if (std::isnan(expected_[i])) continue;
            ASSERT_NEAR(image.pixels[3 * i], expected_[i], 1e-3 * expected_[i]) << name_of(offsets);
        }
    }
}

/// Its bias is small, but not zero.
TEST_P(ClosedForm, BiasedVariantIsClose) {
    for (const auto& row :
         ratio_rows(Technique::projected_solid_angle_biased, renderer_.visibility().tracer()))
        for (const double ratio : row) ASSERT_NEAR(ratio, 1, 1e-2);
}

/// The test of the test: a renderer with a bias of one per cent is rejected.
TEST_P(ClosedForm, RejectsARendererThatIsTooDark) {
    const LossyTracer mutant(renderer_.visibility().tracer(), 0.01);
    for (const Technique technique : {Technique::solid_angle, Technique::projected_solid_angle})
        EXPECT_GT(largest_t_of(technique, mutant.tracer()), kLargestT) << render::name_of(technique);
}

INSTANTIATE_TEST_SUITE_P(Lights, ClosedForm,
                         testing::Values(Case{"panel", make_panel_scene, panel_radiance},
                                         Case{"tube", make_tube_scene, tube_radiance}),
                         [](const auto& test) { return test.param.name; });

} // namespace
} // namespace nusselt::render_test
