#include "info.h"
#include "lights.h"

#include "scene/scene_size.h"
#include "scene/vector_math.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace nusselt::app {

namespace {

using scene::Double3;
using scene::Float3;

std::string text(const Float3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }

double polygon_area(const scene::PolygonLight& light) {
    Double3 sum;
    const Double3 origin = to_double(light.vertices[0]);
    for (std::size_t i = 1; i + 1 < light.vertices.size(); ++i)
        sum = sum + cross(to_double(light.vertices[i]) - origin, to_double(light.vertices[i + 1]) - origin);
    return 0.5 * length(sum);
}

Float3 scaled(double factor, const Float3& v) { return to_float(factor * to_double(v)); }

void print_geometry(const scene::Scene& scene) {
    fmt::print("triangles    {}\nvertices     {}\n", scene.triangles.size(), scene.positions.size());
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Float3 low = {kInfinity, kInfinity, kInfinity};
    Float3 high = {-kInfinity, -kInfinity, -kInfinity};
    for (const Float3& p : scene.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    if (!scene.positions.empty()) fmt::print("bounding box ({}) to ({}) m\n", text(low), text(high));
    fmt::print("radius       {:.6g} m\n", scene.radius);
    fmt::print("arrays       {:.6g} MB\n", 1e-6 * static_cast<double>(scene::array_bytes(scene)));
}

void print_materials(const scene::Scene& scene) {
    fmt::print("\n{} materials\n", scene.materials.size());
    for (const scene::Material& material : scene.materials) {
        const bool is_lambert = material.model == scene::BrdfModel::lambert;
        fmt::print("  {}: {}, diffuse {}", material.name, is_lambert ? "lambert" : "frostbite",
                   text(material.diffuse));
        const auto print_texture = [&](const char* format, const scene::TextureUse& use) {
            if (use.texture >= 0)
                fmt::print(fmt::runtime(format), scene.textures[static_cast<std::size_t>(use.texture)].name);
        };
        print_texture(" times {}", material.diffuse_texture);
        if (!is_lambert) {
            fmt::print(", f0 {}", text(material.f0));
            print_texture(" times {}", material.f0_texture);
            fmt::print(", roughness {:.4g}", material.roughness);
            print_texture(" times {}", material.roughness_texture);
        }
        if (material.alpha != 1 || material.alpha_texture.texture >= 0)
            fmt::print(", alpha {:.4g}", material.alpha);
        print_texture(" times {}", material.alpha_texture);
        print_texture(", bumps {}", material.bump_texture);
        print_texture(", normals {}", material.normal_texture);
        fmt::print("\n");
    }
    fmt::print("\n{} textures\n", scene.textures.size());
    for (const scene::Texture& texture : scene.textures)
        fmt::print("  {}: {} x {}\n", texture.name, texture.width, texture.height);
}

double power(const scene::PolygonLight& light) {
    const double sides = light.two_sided ? 2 : 1;
    const Double3 radiance = to_double(light.radiance);
    return sides * std::numbers::pi * polygon_area(light) * std::max({radiance.x, radiance.y, radiance.z});
}

/// All polygons of an emitter.
void print_emitter(const scene::Scene& scene, std::size_t begin, std::size_t end) {
    double area = 0;
    std::size_t vertices = 0;
    for (std::size_t i = begin; i < end; ++i) {
        area += polygon_area(scene.polygon_lights[i]);
        vertices += scene.polygon_lights[i].vertices.size();
    }
    const scene::PolygonLight& light = scene.polygon_lights[begin];
    const double sides = light.two_sided ? 2 : 1;
    fmt::print("  {}: ", scene.emitters[light.emitter].name);
    if (end - begin > 1) fmt::print("{} polygons, ", end - begin);
    fmt::print("{} vertices, {:.6g} m^2, radiance {} W/(sr m^2), {}power {} W\n", vertices, area,
               text(light.radiance), light.two_sided ? "two-sided, " : "",
               text(scaled(sides * area * std::numbers::pi, light.radiance)));
}

/// Counts polygons that contribute next to nothing but cost as much time as others.
void print_weak_lights(const scene::Scene& scene) {
    constexpr double kWeak = 1e-6;
    double total = 0;
    for (const scene::PolygonLight& light : scene.polygon_lights) total += power(light);
    const auto weak = std::count_if(scene.polygon_lights.begin(), scene.polygon_lights.end(),
                                    [&](const auto& light) { return power(light) < kWeak * total; });
    if (weak > 0) fmt::print("  {} polygons have less than {:g} of the power of all polygons\n", weak, kWeak);
}

void print_lights(const scene::Scene& scene) {
    const std::vector<scene::PolygonLight>& lights = scene.polygon_lights;
    fmt::print("\n{} polygon lights, {} line lights\n", lights.size(), scene.line_lights.size());
    for (std::size_t begin = 0, end = 0; begin < lights.size(); begin = end) {
        while (end < lights.size() && lights[end].emitter == lights[begin].emitter) ++end;
        print_emitter(scene, begin, end);
    }
    print_weak_lights(scene);
    for (const scene::LineLight& light : scene.line_lights) {
        const double extent = length(to_double(light.end) - to_double(light.begin));
        const double area = 2 * std::numbers::pi * static_cast<double>(light.radius) * extent;
        fmt::print("  {}: length {:.6g} m, radius {:.6g} m, radiance {} W/(sr m^2), power {} W\n",
                   scene.emitters[light.emitter].name, extent, light.radius, text(light.radiance),
                   text(scaled(area * std::numbers::pi, light.radiance)));
    }
}

void print_camera(const scene::Scene& scene) {
    const scene::Camera& camera = scene.camera;
    const double half_width = 0.5 * scene.film.width;
    const double half_height = 0.5 * scene.film.height;
    const Double3 center = to_double(camera.corner) + half_width * to_double(camera.right) +
                           half_height * to_double(camera.down);
    const auto field_of_view = [&](const Float3& half_step, double half_size) {
        const double half_angle = std::atan(half_size * length(to_double(half_step)) / length(center));
        return 2 * half_angle * 180 / std::numbers::pi;
    };
    fmt::print("\ncamera       at ({}), looks along ({}), field of view {:.4g} x {:.4g} degrees\n",
               text(camera.origin), text(to_float(normalized(center))),
               field_of_view(camera.right, half_width), field_of_view(camera.down, half_height));
    fmt::print("film         {} x {}{}{}\n", scene.film.width, scene.film.height,
               scene.film.filename.empty() ? "" : ", ", scene.film.filename);
}

} // namespace

void setup_info(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* const command = app.add_subcommand("info", "Print what a scene file contains");
    command->add_option("SCENE", options->scene, "Scene file in pbrt syntax (v3 or v4)")->required();
    add_rigs_option(*command, options->rigs);
    command->callback([options, &exit_code] { exit_code = run_info(*options); });
}

int run_info(const InfoOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    const scene::Scene scene = load_scene(options.scene, options.rigs);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;

    print_geometry(scene);
    print_materials(scene);
    print_lights(scene);
    print_camera(scene);
    fmt::print("\n{} warnings\n", scene.warnings.size());
    for (const std::string& warning : scene.warnings) fmt::print("  {}\n", warning);
    fmt::print("\nloaded in {:.3f} s\n", elapsed.count());
    return 0;
}

} // namespace nusselt::app
