// LightSource directives of pbrt v3 and v4 light a floor as the formulas of pbrt say, which this file has in pbrt's own terms.

#include "base/temporary_folder.h"
#include "render_cpu/renderer.h"
#include "scene/import/importers.h"
#include "scene/model/transform.h"
#include "scene/model/vector_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::render_test {
namespace {

using scene::Double3;
using scene::normalized;
using scene::Transform;

constexpr double kPi = std::numbers::pi;
constexpr int kSize = 32;
constexpr int kMapSize = 8;
constexpr double kAlbedo = 0.6;

/// Of a texel of the map, in rows from above.
Double3 map_texel(int column, int row) {
    const int number = kMapSize * row + column;
    return {0.1 + (number * 7 % 10) / 5.0, 0.2 + (number * 3 % 11) / 6.0, 0.1 + (number * 5 % 13) / 7.0};
}

void write_map(const std::filesystem::path& path) {
    std::ofstream file(path, std::ios::binary);
    file << "PF\n" << kMapSize << " " << kMapSize << "\n-1.0\n";
    for (int row = kMapSize - 1; row >= 0; --row)
        for (int column = 0; column < kMapSize; ++column) {
            const scene::Float3 texel = to_float(map_texel(column, row));
            file.write(reinterpret_cast<const char*>(&texel), sizeof texel);
        }
}

/// The texel that contains a point of the unit square, with y downwards.
Double3 nearest(double x, double y) {
    const auto index = [](double c) { return std::clamp(static_cast<int>(c * kMapSize), 0, kMapSize - 1); };
    return map_texel(index(x), index(y));
}

/// \param wrapped maps the number of a column or row into the map
Double3 bilinear(double x, double y, const std::function<int(int)>& wrapped) {
    const double s = x * kMapSize - 0.5, t = y * kMapSize - 0.5;
    const int left = static_cast<int>(std::floor(s)), upper = static_cast<int>(std::floor(t));
    Double3 sum;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            sum = sum + ((1 - std::fabs(s - left - i)) * (1 - std::fabs(t - upper - j))) *
                            map_texel(wrapped(left + i), wrapped(upper + j));
    return sum;
}

int repeated(int i) { return (i + kMapSize) % kMapSize; }
int clamped(int i) { return std::clamp(i, 0, kMapSize - 1); }

/// pbrt v4: the square of the equal-area map for a direction with y and z exchanged.
Double3 goniometric_v4(const Double3& w) {
    const Double3 d = {w.x, w.z, w.y};
    const double r = std::sqrt(1 - std::fabs(d.z));
    const double phi = std::atan2(std::fabs(d.y), std::fabs(d.x)) * 2 / kPi;
    double v = phi * r;
    double u = r - v;
    if (d.z < 0) {
        std::swap(u, v);
        u = 1 - u;
        v = 1 - v;
    }
    const Double3 texel = nearest(0.5 * (1 + std::copysign(u, d.x)), 0.5 * (1 + std::copysign(v, d.y)));
    const double mean = (texel.x + texel.y + texel.z) / 3;
    return {mean, mean, mean};
}

/// pbrt v3: spherical angles of a direction with y and z exchanged.
Double3 goniometric_v3(const Double3& w) {
    const double theta = std::acos(w.y);
    const double phi = std::atan2(w.z, w.x);
    return bilinear((phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi), theta / kPi, repeated);
}

constexpr double kFov = 70;

/// Where a direction meets the screen, in [0, 1]^2; empty if it does not.
std::optional<std::pair<double, double>> on_screen(const Double3& w) {
    const double scale = std::tan(kFov * kPi / 360);
    const double x = w.x / (w.z * scale), y = w.y / (w.z * scale);
    if (w.z <= 0 || std::max(std::fabs(x), std::fabs(y)) > 1) return std::nullopt;
    return std::pair(0.5 * (1 + x), 0.5 * (1 + y));
}

Double3 projection_v3(const Double3& w) {
    const auto at = on_screen(w);
    return at ? bilinear(at->first, at->second, clamped) : Double3{};
}
Double3 projection_v4(const Double3& w) {
    const auto at = on_screen({w.x, -w.y, w.z});
    return at ? nearest(at->first, at->second) : Double3{};
}

double cosine(double degrees) { return std::cos(degrees * kPi / 180); }
double cone_parameter(const Double3& w, double cone, double delta) {
    return std::clamp((w.z - cosine(cone)) / (cosine(cone - delta) - cosine(cone)), 0.0, 1.0);
}

struct Case {
    std::string name;
    std::string film; ///< "image" stands for v3
    std::string light;
    std::function<Double3(const Double3& w)> intensity; ///< in a unit direction in the space of the light
};

const std::vector<Case>& cases() {
    static const std::vector<Case> kCases = {
        {"point", "rgb", R"("point" "rgb I" [1 2 3] "float scale" 2)",
         [](const Double3&) {
             return Double3{2, 4, 6};
         }},
        {"point_power", "rgb", R"("point" "float power" 100)",
         [](const Double3&) {
             return (100 / (4 * kPi)) * Double3{1, 1, 1};
         }},
        {"point_v3", "image", R"("point" "rgb I" [1 2 3] "rgb scale" [3 2 1])",
         [](const Double3&) {
             return Double3{3, 4, 3};
         }},
        {"spot", "rgb", R"("spot" "rgb I" [1 2 3] "float coneangle" 50 "float conedeltaangle" 30)",
         [](const Double3& w) {
             const double t = cone_parameter(w, 50, 30);
             return (t * t * (3 - 2 * t)) * Double3{1, 2, 3};
         }},
        {"spot_v3", "image", R"("spot" "rgb I" [1 2 3] "float coneangle" 50 "float conedeltaangle" 30)",
         [](const Double3& w) {
             return std::pow(cone_parameter(w, 50, 30), 4) * Double3{1, 2, 3};
         }},
        {"goniometric", "rgb", R"("goniometric" "rgb I" [1 2 3] "string filename" "map.pfm")",
         [](const Double3& w) {
             return per_channel_product({1, 2, 3}, goniometric_v4(w));
         }},
        {"goniometric_v3", "image", R"("goniometric" "rgb I" [1 2 3] "string mapname" "map.pfm")",
         [](const Double3& w) {
             return per_channel_product({1, 2, 3}, goniometric_v3(w));
         }},
        {"projection", "rgb", R"("projection" "float scale" 3 "float fov" 70 "string filename" "map.pfm")",
         [](const Double3& w) { return 3 * projection_v4(w); }},
        {"projection_v3", "image",
         R"("projection" "rgb I" [1 2 3] "float fov" 70 "string mapname" "map.pfm")",
         [](const Double3& w) {
             return per_channel_product({1, 2, 3}, projection_v3(w));
         }},
    };
    return kCases;
}

Double3 to_floor(const scene::Camera& camera, int x, int y) {
    const Double3 origin = to_double(camera.origin) + (x + 0.5) * to_double(camera.origin_right) +
                           (y + 0.5) * to_double(camera.origin_down);
    return {origin.x, origin.y, 0};
}

/// The number of pixels whose radiance is not that of an irradiance of the floor, by more than a 1000th of the largest one.
int wrong_pixels(const std::string& film, const std::string& transforms, const std::string& light,
                 const std::function<Double3(const Double3& point)>& irradiance) {
    const base::TemporaryFolder folder;
    write_map(folder / "map.pfm");
    std::ofstream(folder / "scene.pbrt")
        << "Film \"" << film << "\" \"integer xresolution\" " << kSize << " \"integer yresolution\" " << kSize
        << "\nLookAt 0 0 5  0 0 0  0 1 0\nCamera \"orthographic\" \"float screenwindow\" [-2 2 -2 "
           "2]\nWorldBegin\n"
        << R"(MakeNamedMaterial "m" "string type" )"
        << (film == "image" ? R"("matte" "rgb Kd")" : R"("diffuse" "rgb reflectance")")
        << " [0.6 0.6 0.6]\nNamedMaterial \"m\"\n"
        << "Shape \"trianglemesh\" \"point P\" [-9 -9 0  9 -9 0  9 9 0  -9 9 0] \"integer indices\" [0 1 2 0 "
           "2 3]\n"
        << transforms << "\nLightSource " << light << "\n";
    const scene::Scene scene = scene::load_scene(folder / "scene.pbrt");
    EXPECT_EQ(scene.warnings, std::vector<std::string>());
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 1;
    const image::Image image = render_cpu::Renderer(scene, 2).render(settings, base::choose_isa()).image;
    std::vector<double> expected;
    double largest = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const Double3 e = irradiance(to_floor(scene.camera, x, y));
            for (const double channel : {e.x, e.y, e.z}) {
                expected.push_back(kAlbedo / kPi * channel);
                largest = std::max(largest, expected.back());
            }
        }
    int wrong = 0;
    for (std::size_t i = 0; i < expected.size(); i += 3) {
        bool is_right = true;
        for (std::size_t k = i; k < i + 3; ++k)
            is_right &= std::fabs(image.pixels[k] - expected[k]) <= 1e-3 * largest;
        wrong += is_right ? 0 : 1;
    }
    return wrong;
}

struct Placement {
    const char* text;
    Transform world_from_light;
};

std::vector<Placement> placements() {
    const Transform place = scene::translation({0.3, -0.2, 1.5});
    // They look down, to the floor.
    return {{"Translate 0.3 -0.2 1.5  Rotate 160 1 0.2 0.1", place * scene::rotation(160, {1, 0.2, 0.1})},
            {"Translate 0.3 -0.2 1.5  Scale -2 2 2  Rotate 170 0.3 1 0.4",
             place * scene::scaling({-2, 2, 2}) * scene::rotation(170, {0.3, 1, 0.4})}};
}

std::function<Double3(const Double3&)> irradiance_of(const Case& c, const Transform& world_from_light) {
    const Transform light_from_world = inverse(world_from_light).value();
    const Double3 position = transform_point(world_from_light, {0, 0, 0});
    return [&c, light_from_world, position](const Double3& point) {
        const Double3 away = point - position;
        const double distance = length(away);
        return (position.z / (distance * distance * distance)) *
               c.intensity(normalized(transform_vector(light_from_world, away)));
    };
}

/// A few pixels may lie on the border of two texels.
constexpr int kMostOnBorders = 3;

TEST(PbrtLights, LightAFloorAsPbrtDoes) {
    for (const Case& c : cases())
        for (const Placement& placement : placements())
            EXPECT_LE(
                wrong_pixels(c.film, placement.text, c.light, irradiance_of(c, placement.world_from_light)),
                kMostOnBorders)
                << c.name << ": " << placement.text;
}

/// The test of the test: the formulas of the other version are noticed, and so are images turned over.
TEST(PbrtLights, OfTheOtherVersionAreNoticed) {
    for (const char* name : {"spot", "goniometric", "projection"}) {
        const auto find = [](const std::string& text) -> const Case& {
            return *std::find_if(cases().begin(), cases().end(),
                                 [&](const Case& c) { return c.name == text; });
        };
        const Placement placement = placements()[0];
        EXPECT_GT(wrong_pixels(find(name).film, placement.text, find(name).light,
                               irradiance_of(find(name + std::string("_v3")), placement.world_from_light)),
                  10 * kMostOnBorders)
            << name;
    }
}

TEST(PbrtLights, OfDistantLightsFollowTheirDirection) {
    const Double3 way = transform_vector(scene::rotation(30, {1, 0, 0}), normalized({1, 2, -4}));
    const auto irradiance = [&](double factor) {
        return [&way, factor](const Double3&) { return (factor * -way.z) * Double3{1, 2, 3}; };
    };
    const char* turn = "Translate 5 5 5  Rotate 30 1 0 0";
    for (const char* film : {"rgb", "image"})
        EXPECT_EQ(wrong_pixels(film, turn,
                               R"("distant" "point from" [0 0 4] "point to" [1 2 0] "rgb L" [1 2 3])",
                               irradiance(1)),
                  0);
    EXPECT_EQ(
        wrong_pixels(
            "rgb", turn,
            R"("distant" "point3 from" [0 0 4] "point3 to" [1 2 0] "rgb L" [1 2 3] "float illuminance" 7)",
            irradiance(7)),
        0);
    EXPECT_GT(wrong_pixels("rgb", turn,
                           R"("distant" "point3 from" [0 0 4] "point3 to" [1 2 0] "rgb L" [1 2 3])",
                           irradiance(1.005)),
              0);
}

} // namespace
} // namespace nusselt::render_test
