/// The surfaces of round lights as cameras see them: outlines, their own light, and what touches them.

#include "lights/round_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace nusselt::render_test {
namespace {

using scene::Double3;
using scene::RoundLight;
using scene::RoundModel;

image::Image render(const scene::Scene& scene, int samples) {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = samples;
    return render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
}

/// The ray through the centre of a pixel.
scene::SightRay ray_of(const scene::Scene& scene, int x, int y) {
    const scene::Camera& camera = scene.camera;
    return {to_double(camera.origin),
            to_double(camera.corner) + (x + 0.5) * to_double(camera.right) +
                (y + 0.5) * to_double(camera.down),
            {0, 0, 0},
            {0, 0, 0}};
}

constexpr int kSize = 256;

/// The scene of one light with its outline across the image, without other surfaces.
scene::Scene make_outline(const RoundLight& light, void (*add)(scene::Scene&, RoundLight)) {
    scene::Scene scene;
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add(scene, light);
    const Double3 target = to_double(light.center) + to_double(light.u);
    set_camera(scene, to_float(target + Double3{0.5, -0.7, 4}), to_float(target), {0, 1, 0}, 0.05, kSize,
               kSize);
    set_radius(scene);
    return scene;
}

/// Pixels that are lit where the ray misses the light, or the other way round.
int count_wrong_pixels(const RoundLight& light, void (*add)(scene::Scene&, RoundLight)) {
    const scene::Scene scene = make_outline(light, add);
    const image::Image image = render(scene, 1);
    int count = 0, lit = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const bool is_hit = std::isfinite(scene::LightKind<RoundLight>::hit(light, ray_of(scene, x, y)));
            const bool is_lit = image.pixels[3 * static_cast<std::size_t>(y * kSize + x)] > 0;
            count += is_hit != is_lit ? 1 : 0;
            lit += is_lit ? 1 : 0;
        }
    EXPECT_GT(lit, kSize * kSize / 8);
    EXPECT_LT(lit, kSize * kSize * 7 / 8);
    return count;
}

void add_tessellated(scene::Scene& scene, RoundLight light) { add_tessellated_light(scene, light); }

TEST(RoundSurface, HasTheOutlineOfTheExactShape) {
    RoundLight sheared = sphere({1, 2, 3}, 1);
    sheared.v = {0.3f, 0.8f, 0.2f};
    sheared.w = {0.2f, 0, -0.6f};
    RoundLight disk = sphere({0, 0, 0}, 1);
    disk.model = RoundModel::ellipse;
    disk.w = {0, 0, 0};
    RoundLight ellipse = disk;
    ellipse.v = {0.2f, 0.5f, -0.3f};
    for (const RoundLight& light : {sphere({0, 0, 0}, 1), sphere({30, -20, 10}, 1), sheared, disk, ellipse}) {
        // Rounding of rays decides for some pixels along the outline.
        EXPECT_LE(count_wrong_pixels(light, add_round_light), 1);
        EXPECT_GT(count_wrong_pixels(light, add_tessellated), 5);
    }
}

/// Disks vanish edge-on, and are there a little to the side.
TEST(RoundSurface, IsFlatWhereItIsFlat) {
    RoundLight disk = sphere({0, 0, 0}, 1);
    disk.model = RoundModel::ellipse;
    disk.w = {0, 0, 0};
    for (const float height : {0.0f, 0.01f}) {
        scene::Scene scene;
        scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
        add_round_light(scene, disk);
        set_camera(scene, {0, -4, height}, {0, 0, height}, {0, 0, 1}, 0.01, 64, 64);
        set_radius(scene);
        int lit = 0;
        for (const float value : render(scene, 1).pixels) lit += value > 0 ? 1 : 0;
        EXPECT_EQ(lit > 0, height > 0);
    }
}

/// The wall of a hollow light receives its radiance from all directions, wherever it is: no sample may be lost.
TEST(RoundSurface, LosesNoneOfItsOwnLight) {
    RoundLight ellipsoid = sphere({1, 2, 3}, 2, RoundModel::hollow);
    ellipsoid.u = {2, 0.5f, 0};
    ellipsoid.w = {0.3f, 0.2f, -0.7f};
    RoundLight both = sphere({1, 2, 3}, 2);
    both.two_sided = true;
    for (const RoundLight& light :
         {sphere({1, 2, 3}, 2, RoundModel::hollow), sphere({1000, -2000, 500}, 1, RoundModel::hollow),
          sphere({0, 0, 0}, 1e5f, RoundModel::hollow), sphere({0.1f, 0, 0}, 1e-3f, RoundModel::hollow),
          ellipsoid, both}) {
        scene::Scene scene;
        scene.materials.push_back({.name = "grey", .diffuse = {0.5f, 0.5f, 0.5f}});
        add_round_light(scene, light);
        const Double3 center = to_double(light.center);
        set_camera(scene, light.center, to_float(center + to_double(light.u) + to_double(light.v)), {0, 0, 1},
                   0.8, 32, 32);
        set_radius(scene);
        for (const auto technique :
             {render::Technique::solid_angle, render::Technique::projected_solid_angle}) {
            render::RenderSettings settings;
            settings.samples = 16;
            settings.technique = technique;
            const image::Image image =
                render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
            double sum = 0;
            for (std::size_t i = 0; i < image.pixels.size(); i += 3) sum += double{image.pixels[i]};
            const double mean = sum / (32 * 32);
            const bool is_noisy = technique == render::Technique::solid_angle;
            EXPECT_NEAR(mean, 3 * 1.5, is_noisy ? 0.02 : 1e-5)
                << scene.radius << " m, " << name_of(technique);
        }
    }
}

/// How much weights of samples may vary. \param slope distance from the lowest point of a sphere over its radius
double spread_at(double slope) {
    if (slope > 3) return 1e-5;
    if (slope > 2) return 2e-4;
    if (slope > 0.7) return 1e-3;
    return slope > 0.4 ? 3e-3 : 0.03;
}

/// A floor point below a sphere that touches the floor sees all of it.
TEST(RoundSurface, LightsTheFloorThatItTouches) {
    scene::Scene scene = make_floor(kSize);
    const float radius = 0.5f;
    add_round_light(scene, sphere({0, 0, radius}, radius));
    set_camera(scene, {0, -3, 0.03f}, {0, 0, 0.01f}, {0, 0, 1}, 0.03, kSize, kSize);
    set_radius(scene);
    const image::Image image = render(scene, 1);
    int count = 0;
    double sum = 0, nearest = 1, farthest = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const scene::SightRay ray = ray_of(scene, x, y);
            const double t = -ray.origin.z / ray.direction.z;
            const bool is_floor =
                t > 0 && t < scene::LightKind<RoundLight>::hit(scene.lights.of<RoundLight>()[0], ray);
            if (!is_floor) continue;
            const Double3 p = ray.origin + t * ray.direction;
            const double distance = std::hypot(p.x, p.y, double{radius});
            const double expected = 3 * double{kFloorAlbedo} * std::pow(double{radius} / distance, 3);
            const double ratio = double{image.pixels[3 * static_cast<std::size_t>(y * kSize + x)]} / expected;
            // Rounding may put the floor a little above the lowest point of the sphere. Then the horizon cuts it, and weights of
            // samples vary, more so for wide cones: 16 places of the rim are few for them.
            const double slope = std::hypot(p.x, p.y) / double{radius};
            const double spread = spread_at(slope);
            EXPECT_NEAR(ratio, 1, spread) << x << ' ' << y;
            nearest = std::min(nearest, slope);
            farthest = std::max(farthest, slope);
            sum += ratio;
            ++count;
        }
    EXPECT_GT(count, kSize * kSize / 3);
    EXPECT_NEAR(sum / count, 1, 1e-4);
    EXPECT_LT(nearest, 0.1);
    EXPECT_GT(farthest, 3);
}

/// Between a sphere and the floor that cuts it, no pixel is black.
TEST(RoundSurface, LightsTheFloorThatItCuts) {
    for (const float height : {-0.3f, 0.1f, 0.4f}) {
        scene::Scene scene = make_floor(kSize);
        add_round_light(scene, sphere({0, 0, height}, 0.5f));
        const float rim = std::sqrt(0.25f - height * height);
        set_camera(scene, {0, -3, 0.5f}, {0, -rim, 0}, {0, 0, 1}, 0.01, kSize, kSize);
        set_radius(scene);
        const image::Image image = render(scene, 8);
        int black = 0;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3) black += image.pixels[i] < 0.05f ? 1 : 0;
        EXPECT_EQ(black, 0) << height;
    }
}

} // namespace
} // namespace nusselt::render_test
