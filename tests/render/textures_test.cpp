/// Textures on an unoccluded matte floor below a panel, where the radiance of each pixel has a closed form. The
/// analytic technique has no noise, so that pixels are compared one by one.

#include "scenes.h"

#include <nusselt/geometry/polygon_measures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

namespace nusselt::render_test {
namespace {

using scene::Float2;
using scene::Texture;
using scene::TextureFilter;
using scene::TextureWrap;

constexpr int kSize = 48;
constexpr float kRadiance = 5;
using Point = Vec3<double>;

const std::array<Float3, 4> kPanel = {Float3{-0.8f, -1.5f, 2}, Float3{-0.8f, 0.5f, 2.2f},
                                      Float3{0.9f, 0.5f, 2.2f}, Float3{0.9f, -1.5f, 2}};

/// Texture coordinates as an affine function of the position on the floor.
struct UvMap {
    double u_x = 1, u_y = 0, u = 0;
    double v_x = 0, v_y = 1, v = 0;

    std::array<double, 2> operator()(const Point& p) const {
        return {u_x * p.x + u_y * p.y + u, v_x * p.x + v_y * p.y + v};
    }
};

/// The floor, material 0, below the panel, which the camera does not see.
scene::Scene make_textured_floor(const UvMap& map) {
    scene::Scene scene = make_floor(kSize);
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const Float3& p = scene.positions[i];
        const auto [u, v] = map({p.x, p.y, p.z});
        scene.uvs[i] = {static_cast<float>(u), static_cast<float>(v)};
    }
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add_polygon_light(scene, kPanel, {kRadiance, kRadiance, kRadiance}, false, 1);
    set_radius(scene);
    return scene;
}

image::Image render(const scene::Scene& scene) {
    render::RenderSettings settings;
    settings.technique = render::Technique::ltc_analytic;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 1;
    return render_cpu::Renderer(scene, 2).render(settings, base::choose_isa()).image;
}

Point to_vec(const Float3& v) { return {v.x, v.y, v.z}; }

/// The point where the ray through the centre of a pixel meets the floor.
std::optional<Point> floor_point(const scene::Camera& camera, int x, int y) {
    const Point direction =
        to_vec(camera.corner) + (x + 0.5) * to_vec(camera.right) + (y + 0.5) * to_vec(camera.down);
    if (direction.z >= 0) return std::nullopt;
    const Point eye = to_vec(camera.origin);
    const Point point = eye + (-eye.z / direction.z) * direction;
    if (std::fabs(point.x) > 3.9 || std::fabs(point.y) > 3.9) return std::nullopt;
    return point;
}

/// Light that a white surface with this normal reflects.
double white_radiance(const Point& point, const Point& normal) {
    const Point n = (1 / std::sqrt(dot(normal, normal))) * normal;
    const Point across = cross(n, Point{0.6, 0.8, 0});
    const Point x = (1 / std::sqrt(dot(across, across))) * across;
    const Point y = cross(n, x);
    Point vertices[4];
    for (std::size_t j = 0; j < 4; ++j) {
        const Point d = to_vec(kPanel[j]) - point;
        vertices[j] = {dot(d, x), dot(d, y), dot(d, n)};
    }
    return kRadiance / std::numbers::pi * projected_solid_angle(make_polygon<4>(vertices, 4));
}

/// Radiance of a point of the floor in one channel; NaN where rounding may decide.
using Expected = std::function<double(const Point& point, std::size_t channel)>;

/// The largest relative error of a pixel.
double largest_error(const scene::Scene& scene, const Expected& expected) {
    const image::Image image = render(scene);
    double largest = 0;
    int count = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const auto point = floor_point(scene.camera, x, y);
            if (!point) continue;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const double value = expected(*point, channel);
                if (std::isnan(value)) continue;
                const std::size_t pixel = 3 * static_cast<std::size_t>(y * kSize + x) + channel;
                const double error = std::fabs(static_cast<double>(image.pixels[pixel]) - value);
                largest = std::max(largest, error / white_radiance(*point, {0, 0, 1}));
                ++count;
            }
        }
    EXPECT_GT(count, kSize * kSize / 2);
    return largest;
}

constexpr double kTolerance = 1e-4;

// ---- Lookups

Texture make_texture(int channels, TextureWrap wrap, TextureFilter filter) {
    Texture texture{
        .name = "t", .width = 3, .height = 2, .channels = channels, .wrap = wrap, .filter = filter};
    for (int i = 0; i < 6 * channels; ++i) texture.texels.push_back(static_cast<float>(i * 7 % 11) / 11.0f);
    return texture;
}

/// A texel in any row and column, by the definition of the wrap mode.
double texel(const Texture& texture, long column, long row, std::size_t channel) {
    if (texture.wrap == TextureWrap::black &&
        (column < 0 || column >= texture.width || row < 0 || row >= texture.height))
        return 0;
    if (texture.wrap == TextureWrap::clamp) {
        column = std::clamp(column, 0l, texture.width - 1l);
        row = std::clamp(row, 0l, texture.height - 1l);
    }
    while (column < 0) column += texture.width;
    while (row < 0) row += texture.height;
    const long index = (row % texture.height) * texture.width + column % texture.width;
    const long first = texture.channels * index;
    return texture.texels[static_cast<std::size_t>(first) + (texture.channels == 3 ? channel : 0)];
}

double look_up(const Texture& texture, double s, double t, std::size_t channel) {
    const double x = s * texture.width;
    const double y = t * texture.height;
    if (texture.filter == TextureFilter::nearest) {
        // Within rounding of an edge either texel is right.
        if (std::fabs(x - std::round(x)) < 1e-4 || std::fabs(y - std::round(y)) < 1e-4) return std::nan("");
        return texel(texture, std::lround(std::floor(x)), std::lround(std::floor(y)), channel);
    }
    double sum = 0;
    const long left = std::lround(std::floor(x - 0.5));
    const long below = std::lround(std::floor(y - 0.5));
    // Texels weigh tents around their centres.
    for (long row = below; row <= below + 1; ++row)
        for (long column = left; column <= left + 1; ++column)
            sum += texel(texture, column, row, channel) *
                   (1 - std::fabs(x - 0.5 - static_cast<double>(column))) *
                   (1 - std::fabs(y - 0.5 - static_cast<double>(row)));
    return sum;
}

struct Lookup {
    int channels;
    TextureWrap wrap;
    TextureFilter filter;
};

class TextureLookups : public testing::TestWithParam<Lookup> {};

TEST_P(TextureLookups, MatchTheirDefinition) {
    const auto [channels, wrap, filter] = GetParam();
    const UvMap map{0.3, 0.1, 0.2, -0.2, 0.4, 0.3};
    scene::Scene scene = make_textured_floor(map);
    scene.textures = {make_texture(channels, wrap, filter)};
    scene.materials[0].diffuse = {0.5f, 0.75f, 1};
    scene.materials[0].diffuse_texture = {0, {1.5f, -0.75f}, {0.25f, 0.5f}};
    const double factors[] = {0.5, 0.75, 1};
    const auto expected_for = [&](const Texture& texture) {
        return [&map, &factors, texture](const Point& point, std::size_t channel) {
            const auto [u, v] = map(point);
            const double albedo =
                factors[channel] * look_up(texture, 1.5 * u + 0.25, -0.75 * v + 0.5, channel);
            return albedo * white_radiance(point, {0, 0, 1});
        };
    };
    EXPECT_LT(largest_error(scene, expected_for(scene.textures[0])), kTolerance);

    // The test of the test: it detects any other kind of lookup.
    for (const TextureWrap other : {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::black})
        if (other != wrap) {
            EXPECT_GT(largest_error(scene, expected_for(make_texture(channels, other, filter))), 0.1);
        }
    const bool is_nearest = filter == TextureFilter::nearest;
    const TextureFilter other = is_nearest ? TextureFilter::bilinear : TextureFilter::nearest;
    EXPECT_GT(largest_error(scene, expected_for(make_texture(channels, wrap, other))), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Kinds, TextureLookups,
                         testing::Values(Lookup{3, TextureWrap::repeat, TextureFilter::bilinear},
                                         Lookup{3, TextureWrap::clamp, TextureFilter::bilinear},
                                         Lookup{3, TextureWrap::black, TextureFilter::bilinear},
                                         Lookup{3, TextureWrap::repeat, TextureFilter::nearest},
                                         Lookup{3, TextureWrap::clamp, TextureFilter::nearest},
                                         Lookup{3, TextureWrap::black, TextureFilter::nearest},
                                         Lookup{1, TextureWrap::repeat, TextureFilter::bilinear},
                                         Lookup{1, TextureWrap::black, TextureFilter::nearest}));

TEST(Textures, ReflectancesStayBelowOne) {
    scene::Scene scene = make_textured_floor({});
    scene.textures = {{.name = "grey", .width = 1, .height = 1, .texels = {0.5f, 0.25f, 0.75f}}};
    scene.materials[0].diffuse = {1, 2, 3};
    scene.materials[0].diffuse_texture.texture = 0;
    const double albedo[] = {0.5, 0.5, 1};
    EXPECT_LT(largest_error(scene,
                            [&](const Point& point, std::size_t channel) {
                                return albedo[channel] * white_radiance(point, {0, 0, 1});
                            }),
              kTolerance);
}

// ---- Normals

/// The light of a floor of one normal, where that faces the eye.
Expected with_normal(const scene::Scene& scene, const Point& normal) {
    const Point eye = to_vec(scene.camera.origin);
    return [eye, normal](const Point& point, std::size_t) {
        const Point to_eye = eye - point;
        const bool faces_eye =
            dot(normal, to_eye) > 0.01 * std::sqrt(dot(normal, normal) * dot(to_eye, to_eye));
        return faces_eye ? static_cast<double>(kFloorAlbedo) * white_radiance(point, normal) : std::nan("");
    };
}

/// Turns the floor upside down: its front side, which its material and its bumps refer to, is that below.
void reverse_winding(scene::Scene& scene) {
    for (scene::Triangle& triangle : scene.triangles) std::swap(triangle.vertex[1], triangle.vertex[2]);
}

/// Encodes a unit normal.
Texture normal_map(double x, double y, double z) {
    const auto code = [](double component) { return static_cast<float>(0.5 * component + 0.5); };
    return {.name = "normals", .width = 1, .height = 1, .texels = {code(x), code(y), code(z)}};
}

TEST(NormalMaps, ConstantOnesRotateTheSurface) {
    // u runs along (0.8, 0.6), v to its left.
    scene::Scene scene = make_textured_floor({0.8, 0.6, 0, -0.6, 0.8, 0});
    scene.textures = {normal_map(0.36, -0.48, 0.8)};
    scene.materials[0].normal_texture.texture = 0;
    const Point rotated = {0.36 * 0.8 + 0.48 * 0.6, 0.36 * 0.6 - 0.48 * 0.8, 0.8};
    EXPECT_LT(largest_error(scene, with_normal(scene, rotated)), kTolerance);
    EXPECT_GT(largest_error(scene, with_normal(scene, {0, 0, 1})), 0.05);
    EXPECT_GT(largest_error(scene, with_normal(scene, {-rotated.x, -rotated.y, rotated.z})), 0.05);
}

TEST(NormalMaps, OrthogonaliseTheDirectionOfU) {
    // On the plane, points of equal v lie along x: so does the derivative by u, whatever the direction of v.
    scene::Scene scene = make_textured_floor({1, 5, 0.5, 0, 3, 0});
    scene.textures = {normal_map(0.6, 0, 0.8)};
    scene.materials[0].normal_texture.texture = 0;
    EXPECT_LT(largest_error(scene, with_normal(scene, {0.6, 0, 0.8})), kTolerance);
}

TEST(NormalMaps, MirroredCoordinatesMirrorOnlyU) {
    // The second axis is normal x dp/du in pbrt, not dp/dv.
    scene::Scene scene = make_textured_floor({-1, 0, 0, 0, 1, 0});
    scene.textures = {normal_map(0.48, 0.36, 0.8)};
    scene.materials[0].normal_texture.texture = 0;
    EXPECT_LT(largest_error(scene, with_normal(scene, {-0.48, -0.36, 0.8})), kTolerance);
}

TEST(NormalMaps, BelongToTheFrontSide) {
    scene::Scene scene = make_textured_floor({});
    reverse_winding(scene);
    scene.textures = {normal_map(0.48, -0.36, 0.8)};
    scene.materials[0].normal_texture.texture = 0;
    // (0.48, 0.36, -0.8) on the front side, seen from the back.
    EXPECT_LT(largest_error(scene, with_normal(scene, {-0.48, -0.36, 0.8})), kTolerance);
    // Normals that point into the surface are turned round.
    scene.textures = {normal_map(-0.48, 0.36, -0.8)};
    EXPECT_LT(largest_error(scene, with_normal(scene, {-0.48, -0.36, 0.8})), kTolerance);
}

/// Heights a s + b t at the texel centres.
Texture ramp(double a, double b) {
    Texture texture{.name = "ramp", .width = 4, .height = 8, .channels = 1, .wrap = TextureWrap::clamp};
    for (int row = 0; row < texture.height; ++row)
        for (int column = 0; column < texture.width; ++column)
            texture.texels.push_back(
                static_cast<float>(a * (column + 0.5) / texture.width + b * (row + 0.5) / texture.height));
    return texture;
}

TEST(BumpMaps, ARampIsATiltedPlane) {
    // All of the floor lies between the outermost texel centres.
    const UvMap map{0.06, 0.02, 0.5, -0.01, 0.05, 0.5};
    scene::Scene scene = make_textured_floor(map);
    scene.textures = {ramp(0.75, 0.5)};
    scene.materials[0].bump = 4;
    scene.materials[0].bump_texture = {0, {0.8f, 1.1f}, {0.1f, -0.05f}};
    // height = 4 (0.75 (0.8 u + 0.1) + 0.5 (1.1 v - 0.05))
    const double by_u = 4 * 0.75 * 0.8;
    const double by_v = 4 * 0.5 * 1.1;
    const Point tilted = {-(by_u * map.u_x + by_v * map.v_x), -(by_u * map.u_y + by_v * map.v_y), 1};
    EXPECT_LT(largest_error(scene, with_normal(scene, tilted)), kTolerance);
    EXPECT_GT(largest_error(scene, with_normal(scene, {0, 0, 1})), 0.05);
    EXPECT_GT(largest_error(scene, with_normal(scene, {-tilted.x, -tilted.y, 1})), 0.05);

    // On the other side of the floor the bumps are dents.
    reverse_winding(scene);
    EXPECT_LT(largest_error(scene, with_normal(scene, {-tilted.x, -tilted.y, 1})), kTolerance);
    // A normal map takes precedence.
    scene.textures.push_back(normal_map(0.48, 0.36, 0.8));
    scene.materials[0].normal_texture.texture = 1;
    EXPECT_GT(largest_error(scene, with_normal(scene, {-tilted.x, -tilted.y, 1})), 0.05);
}

/// Gives the floor normals and makes it an instance, which has the size that the floor had.
void make_instance(scene::Scene& scene, double scale_x, double scale_y) {
    for (std::size_t i = 0; i < 4; ++i) {
        scene.positions[i].x /= static_cast<float>(scale_x);
        scene.positions[i].y /= static_cast<float>(scale_y);
        scene.normals[i] = {0, 0, 1};
    }
    // Objects stand behind the triangles of the world.
    const auto move_back = [](auto& array) { std::rotate(array.begin(), array.begin() + 2, array.end()); };
    move_back(scene.triangles);
    move_back(scene.triangle_material);
    move_back(scene.triangle_light);
    scene.objects = {{"floor", static_cast<std::uint32_t>(scene.triangles.size()) - 2, 2}};
    scene.instances = {
        {0, {static_cast<float>(scale_x), 0, 0, 0, 0, static_cast<float>(scale_y), 0, 0, 0, 0, 1, 0}}};
}

/// The normal of pbrt v3 for heights with the given derivatives: unit tangents in the object, moved along the normal.
Point normal_of_pbrt3(const UvMap& map, double scale_x, double scale_y, double by_u, double by_v) {
    const Point n = {0, 0, 1};
    const double determinant = map.u_x * map.v_y - map.u_y * map.v_x;
    const Point dpdu = {map.v_y / determinant / scale_x, -map.v_x / determinant / scale_y, 0};
    const Point ss_before = (1 / std::sqrt(dot(dpdu, dpdu))) * dpdu;
    const Point ts = cross(ss_before, n);
    const Point ss = cross(ts, n);
    const Point moved_u = Point{scale_x * ss.x, scale_y * ss.y, 0} + by_u * n;
    const Point moved_v = Point{scale_x * ts.x, scale_y * ts.y, 0} + by_v * n;
    const Point normal = cross(moved_u, moved_v);
    return normal.z < 0 ? -1.0 * normal : normal;
}

TEST(BumpMaps, MayCountInTextureCoordinates) {
    const UvMap map{0.06, 0.02, 0.5, -0.01, 0.05, 0.5};
    scene::Scene scene = make_textured_floor(map);
    scene.textures = {ramp(0.75, 0.5)};
    scene.materials[0].bump = 0.2f;
    scene.materials[0].bump_unit = scene::BumpUnit::texture_coordinate;
    scene.materials[0].bump_texture = {0, {-0.8f, -1.1f}, {0.9f, 1.05f}};
    const double by_u = -0.2 * 0.75 * 0.8;
    const double by_v = -0.2 * 0.5 * 1.1;
    // A mesh without normals keeps metres.
    const Point in_metres = {-(by_u * map.u_x + by_v * map.v_x), -(by_u * map.u_y + by_v * map.v_y), 1};
    EXPECT_LT(largest_error(scene, with_normal(scene, in_metres)), kTolerance);

    const Point tilted = normal_of_pbrt3(map, 1, 1, by_u, by_v);
    scene::Scene with_normals = scene;
    for (std::size_t i = 0; i < 4; ++i) with_normals.normals[i] = {0, 0, 2};
    EXPECT_LT(largest_error(with_normals, with_normal(scene, tilted)), kTolerance);
    EXPECT_GT(largest_error(with_normals, with_normal(scene, in_metres)), 0.05);
    EXPECT_GT(largest_error(with_normals, with_normal(scene, {-tilted.x, -tilted.y, tilted.z})), 0.05);

    for (const auto& [scale_x, scale_y] : {std::array{1.0, 1.0}, {2.0, 2.0}, {-2.0, 2.0}, {3.0, 0.5}}) {
        scene::Scene with_instance = scene;
        make_instance(with_instance, scale_x, scale_y);
        const Point expected = normal_of_pbrt3(map, scale_x, scale_y, by_u, by_v);
        EXPECT_LT(largest_error(with_instance, with_normal(scene, expected)), kTolerance)
            << scale_x << ", " << scale_y;
    }
}

TEST(BumpMaps, WithoutTextureCoordinatesSurfacesStayFlat) {
    scene::Scene scene = make_textured_floor({0, 0, 0.5, 0, 0, 0.5});
    const image::Image flat = render(scene);
    scene.textures = {ramp(1, 1), normal_map(0.6, 0, 0.8)};
    scene.materials[0].bump_texture.texture = 0;
    EXPECT_EQ(render(scene).pixels, flat.pixels);
    scene.materials[0].normal_texture.texture = 1;
    EXPECT_EQ(render(scene).pixels, flat.pixels);
}

// ---- Lanes

/// Textures of one texel with the given value.
Texture constant(float value, int channels) {
    return {.name = "constant",
            .width = 1,
            .height = 1,
            .texels = std::vector<float>(static_cast<std::size_t>(channels), value),
            .channels = channels};
}

TEST(Textures, ConstantOnesEqualNumbers) {
    scene::Scene scene = make_box_scene(kSize);
    const image::Image with_numbers = render(scene);
    scene::Material& glossy = scene.materials.at(1);
    scene.textures = {constant(glossy.roughness, 1), constant(glossy.f0.x, 3)};
    glossy.roughness = 1;
    glossy.roughness_texture.texture = 0;
    glossy.f0 = {1, 1, 1};
    glossy.f0_texture.texture = 1;
    EXPECT_EQ(render(scene).pixels, with_numbers.pixels);
    scene.textures[0] = constant(0.5f, 1);
    EXPECT_NE(render(scene).pixels, with_numbers.pixels);
    scene.textures[0] = constant(0.6f, 1);
    EXPECT_EQ(render(scene).pixels, with_numbers.pixels);
    scene.textures[1] = constant(0.2f, 3);
    EXPECT_NE(render(scene).pixels, with_numbers.pixels);
}

/// Two texels without interpolation: each pixel must be that of a material with one of the two values.
TEST(Textures, GlossyParametersVaryPerPixel) {
    const auto glossy_floor = [](float roughness, float f0) {
        scene::Scene scene = make_textured_floor({0.5, 0.1, 0.03, 0, 1, 0});
        scene.materials[0].model = scene::BrdfModel::frostbite;
        scene.materials[0].roughness = roughness;
        scene.materials[0].f0 = {f0, f0, f0};
        return scene;
    };
    const image::Image of_value[] = {render(glossy_floor(0.25f, 0.5f)), render(glossy_floor(0.75f, 0.125f))};
    scene::Scene scene = glossy_floor(1, 1);
    scene.textures = {constant(0, 1), constant(0, 1)};
    scene.textures[0].texels = {0.25f, 0.75f};
    scene.textures[1].texels = {0.5f, 0.125f};
    for (Texture& texture : scene.textures) {
        texture.width = 2;
        texture.filter = TextureFilter::nearest;
    }
    scene.materials[0].roughness_texture.texture = 0;
    scene.materials[0].f0_texture.texture = 1;
    const image::Image image = render(scene);
    std::array<int, 2> counts = {0, 0};
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const auto point = floor_point(scene.camera, x, y);
            if (!point) continue;
            const double column = 2 * (0.5 * point->x + 0.1 * point->y + 0.03);
            if (std::fabs(column - std::round(column)) < 1e-4) continue;
            const auto value = static_cast<std::size_t>(std::lround(std::floor(column)) & 1);
            const std::size_t pixel = 3 * static_cast<std::size_t>(y * kSize + x);
            EXPECT_EQ(image.pixels[pixel], of_value[value].pixels[pixel]) << x << ", " << y;
            EXPECT_NE(image.pixels[pixel], of_value[1 - value].pixels[pixel]) << x << ", " << y;
            ++counts[value];
        }
    EXPECT_GT(counts[0], 100);
    EXPECT_GT(counts[1], 100);
}

/// Crops and instruction sets pack pixels differently, so no pixel may depend on the materials of its neighbours.
TEST(Textures, DoNotTouchOtherMaterials) {
    scene::Scene scene = make_textured_floor({});
    scene.materials[0].model = scene::BrdfModel::frostbite;
    scene.materials[0].diffuse = {1.5f, 0.3f, 0.7f};
    scene.materials.push_back(scene.materials[0]);
    // One triangle of the floor has the textures.
    scene.triangle_material[1] = 2;
    const image::Image plain = render(scene);
    scene.textures = {constant(0.5f, 3), ramp(1, 1), normal_map(0.6, 0, 0.8)};
    scene::Material& textured = scene.materials.at(2);
    for (scene::TextureUse* use :
         {&textured.diffuse_texture, &textured.f0_texture, &textured.roughness_texture})
        use->texture = 0;
    textured.bump_texture.texture = 1;
    textured.normal_texture.texture = 2;
    const image::Image image = render(scene);
    int equal = 0;
    int different = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const auto point = floor_point(scene.camera, x, y);
            if (!point || std::fabs(point->x - point->y) < 1e-3) continue;
            const auto pixel = 3 * static_cast<std::ptrdiff_t>(y * kSize + x);
            const bool is_equal = std::equal(plain.pixels.begin() + pixel, plain.pixels.begin() + pixel + 3,
                                             image.pixels.begin() + pixel);
            // The first triangle has the corner with x > y.
            if (point->x > point->y) {
                EXPECT_TRUE(is_equal) << x << ", " << y;
                ++equal;
            } else {
                different += !is_equal;
            }
        }
    EXPECT_GT(equal, 100);
    EXPECT_GT(different, 100);
}

} // namespace
} // namespace nusselt::render_test
