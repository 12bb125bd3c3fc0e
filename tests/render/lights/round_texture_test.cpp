/// Normal and bump maps on round lights that the sun lights: each pixel has a closed form, in which the derivatives of the
/// position by the texture coordinates are differences.

#include "lights/round_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace nusselt::render_test {
namespace {

using scene::Double3;
using scene::normalized;
using scene::RoundLight;
using scene::RoundModel;

constexpr int kSize = 48;
constexpr double kAlbedo = 0.5, kEmission = 0.25, kIrradiance = 3;
constexpr double kPi = std::numbers::pi;

/// A point of the surface by its texture coordinates.
Double3 position(const RoundLight& light, double u, double v) {
    const bool is_flat = light.model == RoundModel::ellipse;
    const double radius = is_flat ? 1 - v : std::sin(kPi * v), angle = 2 * kPi * u;
    const Double3 across = radius * std::cos(angle) * to_double(light.u) +
                           radius * std::sin(angle) * to_double(light.v) + to_double(light.center);
    return is_flat ? across : across - std::cos(kPi * v) * to_double(light.w);
}

/// Where the ray through a pixel meets a light.
struct Place {
    double u, v;
    Double3 normal, along_u, along_v;
};

Place place_of(const RoundLight& light, const Double3& point) {
    const Double3 x = to_double(light.u), y = to_double(light.v), offset = point - to_double(light.center);
    const bool is_flat = light.model == RoundModel::ellipse;
    const Double3 z = is_flat ? cross(x, y) : to_double(light.w);
    const double volume = dot(x, cross(y, z));
    const double a = dot(offset, cross(y, z)) / volume, b = dot(offset, cross(z, x)) / volume,
                 c = dot(offset, cross(x, y)) / volume;
    Place place{};
    place.u = std::atan2(b, a) / (2 * kPi);
    if (place.u < 0) place.u += 1;
    place.v = is_flat ? 1 - std::hypot(a, b) : std::acos(std::fmax(-1, std::fmin(-c, 1))) / kPi;
    constexpr double kStep = 1e-5;
    const auto slope = [&](double by_u, double by_v) {
        return 0.5 / kStep *
               (position(light, place.u + by_u * kStep, place.v + by_v * kStep) -
                position(light, place.u - by_u * kStep, place.v - by_v * kStep));
    };
    place.along_u = slope(1, 0);
    place.along_v = slope(0, 1);
    place.normal = normalized(cross(place.along_u, place.along_v));
    return place;
}

/// The largest error of pixels relative to the brightest ones.
/// \param normal function of a place
template <class Normal>
double largest_error(const RoundLight& light, const scene::Texture& texture, bool is_bump,
                     const Normal& normal) {
    scene::Scene scene;
    scene.materials.push_back({.name = "grey", .diffuse = {kAlbedo, kAlbedo, kAlbedo}});
    scene.textures = {texture};
    (is_bump ? scene.materials[0].bump_texture : scene.materials[0].normal_texture).texture = 0;
    add_round_light(scene, light);
    scene.emitters.push_back({"sun"});
    const Double3 to_sun = normalized({0.6, -0.5, 0.9});
    scene.lights.of<scene::DistantLight>().push_back(
        {.emitter = 1, .direction = to_float(-1.0 * to_sun), .irradiance = {kIrradiance, 1, 1}});
    const Double3 eye = to_double(light.center) + Double3{1.5, -2, 4};
    set_camera(scene, to_float(eye), light.center, {0, 1, 0}, 0.2, kSize, kSize);
    set_radius(scene);
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 1;
    const image::Image image = render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
    double worst = 0;
    int count = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const Double3 direction = to_double(scene.camera.corner) +
                                      (x + 0.5) * to_double(scene.camera.right) +
                                      (y + 0.5) * to_double(scene.camera.down);
            const double t = scene::LightKind<RoundLight>::hit(
                light, {to_double(scene.camera.origin), direction, {0, 0, 0}, {0, 0, 0}});
            if (!std::isfinite(t)) continue;
            const Place place = place_of(light, to_double(scene.camera.origin) + t * direction);
            // Between the outermost texel centres of ramp().
            if (place.u < 0.15 || place.u > 0.85 || place.v < 0.1 || place.v > 0.9) continue;
            const Double3 n = normal(place), to_eye = normalized(-1.0 * direction);
            // The side of the eye and of the sun, before and after.
            constexpr double kLeast = 0.1;
            if (dot(n, to_eye) < kLeast || dot(n, to_sun) < kLeast || dot(place.normal, to_sun) < kLeast)
                continue;
            const double expected = kEmission + kAlbedo / kPi * kIrradiance * dot(n, to_sun);
            worst =
                std::fmax(worst, std::fabs(double{image.pixels[3 * static_cast<std::size_t>(y * kSize + x)]} -
                                           expected));
            ++count;
        }
    EXPECT_GT(count, kSize * kSize / 16);
    return worst;
}

/// A solid and a flat light with axes that are not perpendicular.
std::vector<RoundLight> lights() {
    RoundLight ball = sphere({1, 2, 3}, 0.7f);
    RoundLight sheared = ball;
    sheared.v = {0.3f, 0.8f, 0.2f};
    sheared.w = {0.2f, 0, -0.6f};
    sheared.u = {-0.7f, 0.1f, 0};
    RoundLight ellipse = ball;
    ellipse.model = RoundModel::ellipse;
    ellipse.u = {-0.7f, 0.1f, 0.2f};
    ellipse.v = {-0.2f, -0.8f, 0.1f};
    ellipse.w = {0, 0, 0};
    std::vector<RoundLight> result = {ball, sheared, ellipse};
    for (RoundLight& light : result) light.radiance = {kEmission, kEmission, kEmission};
    return result;
}

constexpr double kTolerance = 2e-5;

TEST(RoundTextures, NormalMapsTurnFromTheDirectionOfU) {
    const auto code = [](double component) { return static_cast<float>(0.5 * component + 0.5); };
    const scene::Texture map{
        .name = "normals", .width = 1, .height = 1, .texels = {code(0.36), code(-0.48), code(0.8)}};
    for (const RoundLight& light : lights()) {
        const auto turned = [](double x, double y) {
            return [x, y](const Place& place) {
                const Double3 tangent = normalized(place.along_u);
                return x * tangent + y * cross(place.normal, tangent) + 0.8 * place.normal;
            };
        };
        EXPECT_LT(largest_error(light, map, false, turned(0.36, -0.48)), kTolerance);
        EXPECT_GT(largest_error(light, map, false, turned(0.36, 0.48)), 0.01);
        EXPECT_GT(largest_error(light, map, false, turned(-0.36, -0.48)), 0.01);
    }
}

TEST(RoundTextures, BumpsDisplaceAlongTheNormal) {
    constexpr double kByU = 0.75, kByV = -0.5; // [m]
    constexpr int kColumns = 16, kRows = 16;   // derivatives reach half a texel to each side
    scene::Texture ramp{
        .name = "ramp", .width = kColumns, .height = kRows, .channels = 1, .wrap = scene::TextureWrap::clamp};
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
            ramp.texels.push_back(
                static_cast<float>(1 + kByU * (column + 0.5) / kColumns + kByV * (row + 0.5) / kRows));
    for (const RoundLight& light : lights()) {
        const auto displaced = [](double by_u, double by_v) {
            return [by_u, by_v](const Place& place) {
                return normalized(
                    cross(place.along_u + by_u * place.normal, place.along_v + by_v * place.normal));
            };
        };
        EXPECT_LT(largest_error(light, ramp, true, displaced(kByU, kByV)), kTolerance);
        EXPECT_GT(largest_error(light, ramp, true, displaced(kByU, 0)), 0.01);
        EXPECT_GT(largest_error(light, ramp, true, displaced(0, kByV)), 0.01);
    }
}

} // namespace
} // namespace nusselt::render_test
