#include "rich_scene.h"

#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace nusselt::render_vulkan_test {

namespace {

using scene::Float3;

/// Random texels.
int add_texture(scene::Scene& scene, int width, int height, int channels, scene::TextureWrap wrap,
                scene::TextureFilter filter, float low, float high) {
    std::mt19937 random(static_cast<unsigned>(scene.textures.size()));
    std::uniform_real_distribution<float> texel(low, high);
    scene::Texture texture{.name = "random",
                           .width = width,
                           .height = height,
                           .channels = channels,
                           .wrap = wrap,
                           .filter = filter};
    for (int i = 0; i < width * height * channels; ++i) texture.texels.push_back(texel(random));
    scene.textures.push_back(texture);
    return static_cast<int>(scene.textures.size()) - 1;
}

int add_material(scene::Scene& scene, const scene::Material& material) {
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

/// A quadrilateral with texture coordinates from 0 to `repeats`, and bent normals.
void add_textured_quad(scene::Scene& scene, const std::array<Float3, 4>& corners, int material,
                       float repeats) {
    const std::size_t first = scene.positions.size();
    render_test::add_quad(scene, corners, material);
    for (std::size_t i = first; i < scene.positions.size(); ++i) {
        const std::size_t corner = (i - first) % 4;
        scene.uvs[i] = {corner == 1 || corner == 2 ? repeats : -0.3f, corner >= 2 ? repeats : -0.2f};
    }
}

} // namespace

scene::Scene make_rich_scene(int width, int height) {
    using scene::TextureFilter;
    using scene::TextureWrap;
    scene::Scene scene;
    const auto texture = [&](int w, int h, int channels, TextureWrap wrap, TextureFilter filter) {
        return add_texture(scene, w, h, channels, wrap, filter, 0.1f, 0.9f);
    };
    const int repeated = texture(7, 5, 3, TextureWrap::repeat, TextureFilter::bilinear);
    const int clamped = texture(4, 4, 3, TextureWrap::clamp, TextureFilter::nearest);
    const int framed = texture(6, 3, 1, TextureWrap::black, TextureFilter::bilinear);
    const int heights = texture(8, 8, 1, TextureWrap::repeat, TextureFilter::bilinear);
    const int normals = add_texture(scene, 8, 8, 3, TextureWrap::repeat, TextureFilter::bilinear, 0.4f, 1.0f);

    const int floor = add_material(scene, {.name = "floor",
                                           .model = scene::BrdfModel::frostbite,
                                           .diffuse = {0.9f, 0.8f, 0.7f},
                                           .diffuse_texture = {repeated, {2, 1.5f}, {0.1f, 0.2f}},
                                           .f0 = {1, 1, 1},
                                           .f0_texture = {clamped},
                                           .roughness = 0.6f,
                                           .roughness_texture = {framed}});
    const int wall = add_material(
        scene, {.name = "wall", .diffuse_texture = {clamped}, .bump = 0.02f, .bump_texture = {heights}});
    const int side = add_material(scene, {.name = "side",
                                          .model = scene::BrdfModel::frostbite,
                                          .roughness = 0.3f,
                                          .normal_texture = {normals}});
    const int curtain = add_material(scene, {.name = "curtain", .alpha_texture = {framed}});
    const int veil = add_material(scene, {.name = "veil", .alpha = 0.4f});
    const int emitter = add_material(scene, {.name = "emitter", .diffuse = {0.2f, 0.2f, 0.2f}});

    add_textured_quad(scene, {Float3{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, floor, 3);
    add_textured_quad(scene, {Float3{-2, 2, 0}, {2, 2, 0}, {2, 2, 3}, {-2, 2, 3}}, wall, 2);
    add_textured_quad(scene, {Float3{-2, -2, 0}, {-2, 2, 0}, {-2, 2, 3}, {-2, -2, 3}}, side, 2);
    add_textured_quad(scene,
                      {Float3{0.4f, 0.2f, 0.3f}, {1.6f, 0.4f, 0.3f}, {1.6f, 0.4f, 1.8f}, {0.4f, 0.2f, 1.8f}},
                      curtain, 1.2f);
    add_textured_quad(
        scene, {Float3{-1.5f, -0.5f, 1.2f}, {-0.5f, -0.5f, 1.3f}, {-0.5f, 0.5f, 1.2f}, {-1.5f, 0.5f, 1.3f}},
        veil, 1);
    render_test::add_polygon_light(
        scene, {Float3{-0.6f, -0.4f, 2.9f}, {-0.6f, 0.4f, 2.9f}, {0.6f, 0.4f, 2.9f}, {0.6f, -0.4f, 2.9f}},
        {6, 5, 4}, false, emitter);
    render_test::add_polygon_light(
        scene, {Float3{1.9f, -0.5f, 1}, {1.9f, 0.5f, 1}, {1.9f, 0.5f, 1.6f}, {1.9f, -0.5f, 1.6f}}, {1, 2, 3},
        true, emitter);
    render_test::add_line_light(
        scene, "tube", {.start = {-1, 1, 2}, .end = {1, 1.2f, 2.2f}, .radius = 0.05f, .radiance = {5, 5, 6}});
    render_test::add_line_light(scene, "line",
                                {.start = {-1.5f, -1, 0.5f},
                                 .end = {-1.5f, 0, 0.8f},
                                 .radius = 0.01f,
                                 .radiance = {30, 20, 10},
                                 .model = scene::TubeModel::linear});
    render_test::add_line_light(scene, "open tube",
                                {.start = {0.2f, -0.6f, 1.4f},
                                 .end = {0.3f, -0.5f, 1.7f},
                                 .radius = 0.12f,
                                 .radiance = {4, 6, 4},
                                 .model = scene::TubeModel::open});
    render_test::add_line_light(scene, "strip",
                                {.start = {-0.5f, 1.5f, 1},
                                 .end = {0.5f, 1.5f, 1},
                                 .radius = 0.03f,
                                 .radiance = {20, 10, 30},
                                 .model = scene::TubeModel::strip,
                                 .normal = {0, 0.8f, 0.6f}});

    // A pyramid with normals, about the origin of its own coordinates.
    scene.objects.push_back({"pyramid", static_cast<std::uint32_t>(scene.triangles.size()), 0});
    add_textured_quad(scene, {Float3{-0.4f, -0.4f, 0}, {0.4f, -0.4f, 0}, {0, 0, 0.7f}, {0, 0, 0.7f}}, side,
                      1);
    add_textured_quad(scene, {Float3{0.4f, -0.4f, 0}, {0.3f, 0.4f, 0}, {0, 0, 0.7f}, {0, 0, 0.7f}}, wall, 1);
    add_textured_quad(scene, {Float3{0.3f, 0.4f, 0}, {-0.4f, -0.4f, 0}, {0, 0, 0.7f}, {0, 0, 0.7f}}, floor,
                      1);
    scene::Object& object = scene.objects.back();
    object.triangle_count = static_cast<std::uint32_t>(scene.triangles.size()) - object.first_triangle;
    scene.instances.push_back({0, {1, 0, 0, -0.8f, 0, 1, 0, -0.2f, 0, 0, 1, 0.01f}});
    scene.instances.push_back({0, {-0.6f, 0.5f, 0, 0.9f, 0.5f, 0.6f, 0, -0.9f, 0, 0.2f, 1.5f, 0.01f}});

    render_test::set_camera(scene, {0.3f, -4.5f, 1.7f}, {0, 0, 1.2f}, {0, 0, 1}, 0.45, width, height);
    render_test::set_radius(scene);
    return scene;
}

scene::Scene make_opaque_scene(int width, int height) {
    scene::Scene scene = make_rich_scene(width, height);
    for (scene::Material& material : scene.materials) {
        material.alpha = 1;
        material.alpha_texture = {};
    }
    return scene;
}

scene::Scene make_plain_scene(int width, int height) {
    scene::Scene scene = make_opaque_scene(width, height);
    scene.instances.clear();
    for (scene::Material& material : scene.materials)
        for (scene::TextureUse* use :
             {&material.diffuse_texture, &material.f0_texture, &material.roughness_texture,
              &material.alpha_texture, &material.bump_texture, &material.normal_texture})
            *use = {};
    return scene;
}

std::shared_ptr<const scene::Luminaire> make_luminaire() {
    scene::IntensityTable table;
    constexpr int kVerticals = 13;
    for (int i = 0; i < kVerticals; ++i)
        table.vertical.push_back((i + 0.01 * (i % 3)) * 0.6 * std::numbers::pi / kVerticals);
    table.horizontal = {0.3, 1, 2.5, 4, 6};
    for (const double h : table.horizontal)
        for (const double v : table.vertical)
            table.candelas.push_back(100 * (1 + std::cos(h)) * std::pow(std::sin(3 * v + h), 2) +
                                     50 * std::cos(0.5 * v));
    return std::make_shared<const scene::Luminaire>(
        scene::Luminaire{"lamp", "lamp", scene::IntensityProfile(table)});
}

scene::Scene make_scene_of_light_sources(int width, int height) {
    using scene::PointDistribution;
    scene::Scene scene = make_plain_scene(width, height);
    // Each kind of light makes drivers compile longer.
    scene.lights.clear();
    scene.emitters.clear();
    std::fill(scene.triangle_light.begin(), scene.triangle_light.end(), -1);
    const auto add = [&](auto light) {
        light.emitter = static_cast<std::uint32_t>(scene.emitters.size());
        scene.emitters.push_back({"light"});
        scene.lights.of<decltype(light)>().push_back(light);
    };
    const scene::PointLight lamp{.position = {0.5f, -0.8f, 2.2f},
                                 .intensity = {4, 5, 6},
                                 .x_axis = {0, 1, 0},
                                 .y_axis = {0.6f, 0, 0.8f},
                                 .z_axis = {0.8f, 0, -0.6f},
                                 .cone_angle = 85,
                                 .full_angle = 5,
                                 .half_extent = {0.7f, 0.4f}};
    for (const auto distribution : {PointDistribution::isotropic, PointDistribution::smooth_cone,
                                    PointDistribution::quartic_cone, PointDistribution::octahedral_image,
                                    PointDistribution::latitude_image, PointDistribution::projected_image}) {
        scene::PointLight light = lamp;
        light.distribution = distribution;
        light.position.x -= 0.3f * static_cast<float>(scene.emitters.size());
        // The images of other surfaces: repeated and smooth, clamped and nearest.
        light.texture = distribution == PointDistribution::octahedral_image ? 1 : 0;
        add(light);
    }
    scene::PointLight luminaire = lamp;
    luminaire.position = {-0.8f, 0.6f, 2};
    scene.luminaires.push_back(make_luminaire());
    luminaire.profile = 0;
    set_profile(*scene.luminaires[0], luminaire);
    add(luminaire);
    add(scene::DistantLight{.direction = {0.48f, 0.64f, -0.6f}, .irradiance = {2, 1, 3}});
    return scene;
}

} // namespace nusselt::render_vulkan_test
