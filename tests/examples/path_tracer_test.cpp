// The example as a user compiles it, except for its main function. Its picture is compared with a path tracer that
// samples the area of the lights by itself.
#define main path_tracer_main
#include "examples/path_tracer/path_tracer.cpp"
#undef main

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using Engine = std::mt19937_64;

float uniform(Engine& engine) { return std::uniform_real_distribution<float>(0, 0.999999f)(engine); }

/// Uniform in area: radiance times both cosines times area over the squared distance.
Vec panel_by_area(const Scene& scene, const Vec& point, const Vec& normal, Engine& engine) {
    const auto& panel = scene.panel.shape;
    const float u = uniform(engine);
    const Vec on_light = panel.vertex[0] + u * panel.edge[0] - uniform(engine) * panel.edge[3];
    const Vec to_light = on_light - point;
    const Vec wi = normalize(to_light);
    const float cosine = dot(normal, wi);
    const float cosine_at_light = -dot(panel.normal, wi);
    if (cosine <= 0 || cosine_at_light <= 0 || !scene.visible(point, normal, on_light)) return {};
    const float area = length(cross(panel.edge[0], panel.edge[1]));
    return (cosine * cosine_at_light * area / dot(to_light, to_light) /
            nusselt::kPi<float>)*scene.panel.radiance;
}

/// Uniform in length: seen from afar, a thin tube has an area of 2 radius length sin(angle to the axis).
Vec tube_by_length(const Scene& scene, const Vec& point, const Vec& normal, Engine& engine) {
    const auto& line = scene.tube.shape;
    const Vec on_light = line.p0 + (uniform(engine) * line.length) * line.s;
    const Vec to_light = on_light - point;
    const Vec wi = normalize(to_light);
    const float cosine = dot(normal, wi);
    if (cosine <= 0 || !scene.visible(point, normal, on_light)) return {};
    const float area = 2 * scene.tube.radius * line.length * length(cross(wi, line.s));
    return (cosine * area / dot(to_light, to_light) / nusselt::kPi<float>)*scene.tube.radiance;
}

/// Does the same as radiance() of the example, with other techniques for the lights and for directions.
Vec reference_radiance(const Scene& scene, Vec origin, Vec direction, int bounces, Engine& engine) {
    Hit hit = scene.closest(origin, direction);
    const Vec light = seen_light(scene, origin, direction, hit.distance);
    if (light.x > 0) return light;
    Vec sum{}, throughput{1, 1, 1};
    for (int bounce = 0; bounce <= bounces && hit.distance < kNowhere; ++bounce) {
        const Vec point = origin + hit.distance * direction;
        const Vec normal = dot(hit.normal, direction) < 0 ? hit.normal : -hit.normal;
        throughput = tint(throughput, hit.albedo);
        const Vec panel = panel_by_area(scene, point, normal, engine);
        sum = sum + tint(throughput, panel + tube_by_length(scene, point, normal, engine));
        // A point on a sphere around the tip of the normal has a cosine density.
        std::normal_distribution<float> normal_distribution;
        const float x = normal_distribution(engine);
        const float y = normal_distribution(engine);
        direction = normalize(normal + normalize(Vec{x, y, normal_distribution(engine)}));
        origin = point + kOffset * normal;
        hit = scene.closest(origin, direction);
    }
    return sum;
}

struct Mean {
    double mean;
    double standard_error;
};

/// The mean of independent, equally good estimates.
Mean mean_of(const std::vector<double>& values) {
    double sum = 0, squares = 0;
    for (const double x : values) sum += x;
    const double count = static_cast<double>(values.size());
    for (const double x : values) squares += (x - sum / count) * (x - sum / count);
    return {sum / count, std::sqrt(squares / (count - 1) / count)};
}

/// Mean of the blue channel over the picture, without pixels that show a light, from independent runs with random rays
/// of the camera.
/// \param trace radiance along a ray.
template <class Trace>
Mean picture_mean(const Scene& scene, int runs, int rays, Engine& engine, const Trace& trace) {
    std::vector<double> means;
    for (int run = 0; run < runs; ++run) {
        double sum = 0;
        for (int i = 0; i < rays; ++i) {
            const float px = uniform(engine) - 0.5f;
            const Vec direction = normalize(Vec{4.0f / 3 * px, uniform(engine) - 0.5f, -1});
            const Hit hit = scene.closest(kEye, direction);
            if (seen_light(scene, kEye, direction, hit.distance).z == 0) sum += trace(direction).z;
        }
        means.push_back(sum / rays);
    }
    return mean_of(means);
}

TEST(PathTracerExample, RadianceAgreesWithAreaSampling) {
    constexpr int kRuns = 24, kRays = 20000, kBounces = 3;
    const Scene scene = make_scene();
    Engine engine(1);
    const Mean reference = picture_mean(scene, kRuns, kRays, engine, [&](const Vec& direction) {
        return reference_radiance(scene, kEye, direction, kBounces, engine);
    });
    Random random(3);
    const Mean ours = picture_mean(scene, kRuns, kRays, engine, [&](const Vec& direction) {
        return radiance(scene, kEye, direction, kBounces, random);
    });
    const double error = std::hypot(reference.standard_error, ours.standard_error);
    EXPECT_NEAR(ours.mean, reference.mean, 4 * error);
    EXPECT_LT(error, 0.004 * reference.mean) << "the comparison says too little";
}

TEST(PathTracerExample, PictureShowsTheRadiance) {
    constexpr int kWidth = 24, kHeight = 18, kSamples = 64, kBounces = 1;
    const Scene scene = make_scene();
    const std::vector<Vec> pixels = render(scene, kWidth, kHeight, kSamples, kBounces);
    for (const Vec& c : pixels) EXPECT_TRUE(c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x + c.y + c.z < 100);
    // In the middle of the left wall and of the right one: pixels without lights and shadows.
    for (const int x : {2, kWidth - 3}) {
        const Vec found = pixels[kHeight / 2 * kWidth + x];
        Random random(5);
        Engine engine(6);
        std::vector<double> green;
        for (int i = 0; i < 20000; ++i) {
            const float px = (static_cast<float>(x) + uniform(engine)) / kWidth - 0.5f;
            const float py = (kHeight / 2 + uniform(engine)) / kHeight - 0.5f;
            const Vec direction = normalize(Vec{4.0f / 3 * px, -py, -1});
            green.push_back(radiance(scene, kEye, direction, kBounces, random).y);
        }
        const Mean expected = mean_of(green);
        EXPECT_NEAR(found.y, expected.mean, 5 * expected.standard_error * std::sqrt(20000.0 / kSamples));
    }
}

// The benefit of the technique: without occluders, all samples give the same result.
TEST(PathTracerExample, DirectLightHasNoNoise) {
    Scene scene = make_scene();
    scene.spheres.clear();
    const Vec point{-1.2f, 0, -1.0f};
    const auto frame = Frame<float>::from_normal(Vec{0, 1, 0});
    Random random(7);
    const Vec first_panel = light_of_panel(scene, point, frame, random);
    const Vec first_tube = light_of_tube(scene, point, frame, random);
    EXPECT_GT(first_panel.x, 0);
    EXPECT_GT(first_tube.x, 0);
    Engine engine(2);
    std::vector<double> panel, tube;
    for (int i = 0; i < 20000; ++i) {
        EXPECT_NEAR(light_of_panel(scene, point, frame, random).x, first_panel.x, 1e-5 * first_panel.x);
        EXPECT_NEAR(light_of_tube(scene, point, frame, random).z, first_tube.z, 1e-5 * first_tube.z);
        panel.push_back(panel_by_area(scene, point, frame.n, engine).x);
        tube.push_back(tube_by_length(scene, point, frame.n, engine).z);
    }
    EXPECT_NEAR(first_panel.x, mean_of(panel).mean, 4 * mean_of(panel).standard_error);
    EXPECT_NEAR(first_tube.z, mean_of(tube).mean, 4 * mean_of(tube).standard_error);
}

} // namespace
