#include "info.h"
#include "apps/common/render_setup.h"
#include "lights.h"
#include "profile_info.h"

#include "base/stopwatch.h"
#include "scene/import/ies/ies_file.h"
#include "scene/model/bounds.h"
#include "scene/model/brdf_name.h"
#include "scene/model/lights/light_report.h"
#include "scene/model/scene_size.h"
#include "scene/model/vector_math.h"

#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace nusselt::app {

namespace {

using scene::Double3;
using scene::Float3;

std::string text(const Float3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }

void print_geometry(const scene::Scene& scene) {
    fmt::print("triangles    {}\nvertices     {}\n", scene.triangles.size(), scene.positions.size());
    if (!scene.objects.empty())
        fmt::print("objects      {} with {} triangles\ninstances    {}\n", scene.objects.size(),
                   scene.triangles.size() - scene::world_triangle_count(scene), scene.instances.size());
    const scene::Bounds box = scene::scene_bounds(scene);
    if (!box.is_empty())
        fmt::print("bounding box ({}) to ({}) m\n", text(to_float(box.low)), text(to_float(box.high)));
    fmt::print("radius       {:.6g} m\n", scene.radius);
    fmt::print("arrays       {:.6g} MB\n", 1e-6 * static_cast<double>(scene::array_bytes(scene)));
}

void print_materials(const scene::Scene& scene) {
    fmt::print("\n{} materials\n", scene.materials.size());
    for (const scene::Material& material : scene.materials) {
        fmt::print("  {}: {}, diffuse {}", material.name, name_of(material.model), text(material.diffuse));
        const auto print_texture = [&](const char* format, const scene::TextureUse& use) {
            if (use.texture >= 0)
                fmt::print(fmt::runtime(format), scene.textures[static_cast<std::size_t>(use.texture)].name);
        };
        print_texture(" times {}", material.diffuse_texture);
        if (material.model != scene::BrdfModel::lambert) {
            fmt::print(", f0 {}", text(material.f0));
            print_texture(" times {}", material.f0_texture);
        }
        if (material.model == scene::BrdfModel::frostbite) {
            fmt::print(", roughness {:.4g}", material.roughness);
            print_texture(" times {}", material.roughness_texture);
        }
        if (material.model == scene::BrdfModel::phong) fmt::print(", exponent {:.6g}", material.exponent);
        if (material.alpha != 1 || material.alpha_texture.texture >= 0)
            fmt::print(", alpha {:.4g}", material.alpha);
        print_texture(" times {}", material.alpha_texture);
        if (material.bump_texture.texture >= 0) {
            const bool is_in_metres = material.bump_unit == scene::BumpUnit::metre;
            fmt::print(", bumps {:.4g}{}", material.bump, is_in_metres ? " m" : "");
            print_texture(" times {}", material.bump_texture);
            if (!is_in_metres) fmt::print(" (as in pbrt v3)");
        }
        print_texture(", normals {}", material.normal_texture);
        fmt::print("\n");
    }
    fmt::print("\n{} textures\n", scene.textures.size());
    for (const scene::Texture& texture : scene.textures)
        fmt::print("  {}: {} x {}\n", texture.name, texture.width, texture.height);
}

/// Rounds, to hide the rounding errors of cameras.
std::string direction_text(const Double3& direction) {
    const auto rounded = [](double c) { return 1e-6 * std::round(1e6 * c) + 0.0; };
    const Double3 unit = normalized(direction);
    return text(to_float(Double3{rounded(unit.x), rounded(unit.y), rounded(unit.z)}));
}

/// A vector with a constant part and one per pixel, at the centre of the film.
Double3 at_center(const scene::Film& film, const Float3& constant, const Float3& right, const Float3& down) {
    return to_double(constant) + 0.5 * film.width * to_double(right) + 0.5 * film.height * to_double(down);
}

void print_camera(const scene::Scene& scene) {
    const scene::Camera& camera = scene.camera;
    const scene::Film& film = scene.film;
    const Double3 direction = at_center(film, camera.corner, camera.right, camera.down);
    fmt::print("\ncamera       at ({}), looks along ({}), ",
               text(to_float(at_center(film, camera.origin, camera.origin_right, camera.origin_down))),
               direction_text(direction));
    const auto extent = [](const Float3& step, int pixels) { return pixels * length(to_double(step)); };
    const auto field_of_view = [&](const Float3& step, int pixels) {
        const double half_angle = std::atan(0.5 * extent(step, pixels) / length(direction));
        return 2 * half_angle * 180 / std::numbers::pi;
    };
    if (length(to_double(camera.origin_right)) > 0)
        fmt::print("orthographic, {:.4g} x {:.4g} m\n", extent(camera.origin_right, film.width),
                   extent(camera.origin_down, film.height));
    else
        fmt::print("field of view {:.4g} x {:.4g} degrees\n", field_of_view(camera.right, film.width),
                   field_of_view(camera.down, film.height));
}

const char* name_of(scene::FilterKind kind) {
    switch (kind) {
    case scene::FilterKind::box:
        return "box";
    case scene::FilterKind::triangle:
        return "triangle";
    case scene::FilterKind::gaussian:
        return "gaussian";
    case scene::FilterKind::mitchell:
        break;
    }
    return "mitchell";
}

void print_film(const scene::Film& film) {
    fmt::print("film         {} x {}{}{}\n", film.width, film.height, film.filename.empty() ? "" : ", ",
               film.filename);
    if (film.crop)
        fmt::print("crop         {} <= x < {}, {} <= y < {}\n", film.crop->x_begin, film.crop->x_end,
                   film.crop->y_begin, film.crop->y_end);
    fmt::print("filter       {}, radii {:.4g} x {:.4g} pixels\n", name_of(film.filter.kind),
               film.filter.radius_x, film.filter.radius_y);
}

} // namespace

void setup_info(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* const command =
        app.add_subcommand("info", "Print what a scene file or an IES profile contains.");
    command
        ->add_option("SCENE", options->scene,
                     "Scene file in pbrt syntax, version 3 or 4, or IES profile of a luminaire (.ies)")
        ->required();
    add_rigs_option(*command, options->rigs);
    command->callback([options, &exit_code] { exit_code = run_info(*options); });
}

int run_info(const InfoOptions& options) {
    if (scene::is_ies_file(options.scene)) {
        if (!options.rigs.empty()) throw CLI::ValidationError("--lights", "changes scenes, not IES profiles");
        return run_profile_info(options.scene);
    }
    const base::Stopwatch stopwatch;
    const scene::Scene scene = load_scene(options.scene, options.rigs);
    const double seconds = stopwatch.seconds();

    print_geometry(scene);
    print_materials(scene);
    fmt::print("\n");
    write_light_report(scene, std::cout);
    print_camera(scene);
    print_film(scene.film);
    fmt::print("\n{} {}\n", scene.warnings.size(), scene.warnings.size() == 1 ? "warning" : "warnings");
    for (const std::string& warning : scene.warnings) fmt::print("  {}\n", warning);
    fmt::print("\nloaded in {:.3f} s\n", seconds);
    return 0;
}

} // namespace nusselt::app
