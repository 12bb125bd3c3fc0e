#include "scene/build/lights/round_light.h"

#include "scene/build/lights/emission_warnings.h"
#include "scene/build/lights/polygon_light.h"
#include "scene/build/lights/profiled_light.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace nusselt::scene {

namespace {

bool is_whole(const Sphere& sphere) {
    const bool has_caps = std::min(sphere.z_min, sphere.z_max) <= -sphere.radius &&
                          std::max(sphere.z_min, sphere.z_max) >= sphere.radius;
    return has_caps && sphere.sweep_degrees >= 360;
}

bool is_whole(const Disk& disk) { return disk.inner_radius == 0 && disk.sweep_degrees >= 360; }

/// The shape of a light, which emits outwards or to the side of the normal. Nothing for other shapes, parts of these, and
/// transforms with perspective.
std::optional<RoundLight> shape_of(const Geometry& geometry, const Transform& world_from_object) {
    if (!is_affine(world_from_object)) return std::nullopt;
    const auto axis = [&](double x, double y, double z) {
        return to_float(transform_vector(world_from_object, {x, y, z}));
    };
    RoundLight light;
    if (const auto* const sphere = std::get_if<Sphere>(&geometry); sphere != nullptr && is_whole(*sphere)) {
        light.model = RoundModel::ellipsoid;
        light.center = to_float(transform_point(world_from_object, {}));
        light.u = axis(sphere->radius, 0, 0);
        light.v = axis(0, sphere->radius, 0);
        light.w = axis(0, 0, sphere->radius);
        return light;
    }
    const auto* const disk = std::get_if<Disk>(&geometry);
    if (disk == nullptr || !is_whole(*disk)) return std::nullopt;
    light.model = RoundModel::ellipse;
    light.center = to_float(transform_point(world_from_object, {0, 0, disk->height}));
    light.u = axis(disk->radius, 0, 0);
    light.v = axis(0, disk->radius, 0);
    light.w = {0, 0, 0};
    // A mirror image emits to the side of the image of the normal.
    if (linear_determinant(world_from_object) < 0) light.v = axis(0, -disk->radius, 0);
    return light;
}

bool has_flat_profile(const Geometry& geometry, const Emission& emission) {
    return emission.profile != nullptr && std::holds_alternative<Disk>(geometry);
}

void reverse(RoundLight& light) {
    if (light.model == RoundModel::ellipse)
        light.v = {-light.v.x, -light.v.y, -light.v.z};
    else
        light.model = RoundModel::hollow;
}

} // namespace

bool becomes_round_light(const Geometry& geometry, const Emission& emission,
                         const Transform& world_from_object) {
    if (is_black(emission.radiance) || emission.texture != nullptr) return false;
    if (has_flat_profile(geometry, emission)) return false;
    const std::optional<RoundLight> light = shape_of(geometry, world_from_object);
    return light && LightKind<RoundLight>::is_valid(*light);
}

std::string_view why_not_round(const Geometry& geometry, const Emission& emission,
                               const Transform& world_from_object) {
    if (emission.texture != nullptr) return "it emits an image";
    if (has_flat_profile(geometry, emission)) return "its radiance depends on the direction";
    if (!shape_of(geometry, {})) return "it is not whole";
    if (!is_affine(world_from_object)) return "its transform has perspective";
    return "it is too thin or too small for single precision";
}

BuiltShape build_round_light(const PlacedShape& placed, const FormatWords& words) {
    const ShapeDescription& shape = *placed.shape;
    BuiltShape built;
    RoundLight light = shape_of(shape.geometry, placed.world_from_object).value();
    if (shape.reverse_orientation) reverse(light);
    light.two_sided = shape.emission.two_sided;

    LightSurface made = surface(light, placed.max_sides);
    built.positions = std::move(made.positions);
    built.normals = std::move(made.normals);
    built.uvs = std::move(made.uvs);
    built.triangles = std::move(made.triangles);
    built.triangle_light.assign(built.triangles.size(), 0);
    if (shape.emission.profile != nullptr) {
        const std::shared_ptr<const Luminaire>& luminaire = shape.emission.profile->luminaire;
        if (const Darkness dark = luminaire == nullptr ? Darkness() : darkness(*luminaire)) {
            make_dark(shape, *dark, built);
            return built;
        }
        warn_of_too_many_normals(shape, built.warnings);
    }
    light.radiance = radiance_of(without_profile(shape.emission), area(light), words.emission, shape.origin);
    built.lights.of<RoundLight>() = {light};
    if (shape.is_invisible) remove_surface(built);
    return built;
}

} // namespace nusselt::scene
