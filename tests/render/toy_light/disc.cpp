#include "disc.h"

#include "scene/model/bounds.h"
#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_text.h"
#include "scene/model/transform.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace nusselt::scene {

namespace {

using Kind = LightKind<DiscLight>;

/// The corner of a polygon around the disc.
double area_of(const DiscLight& light) { return std::numbers::pi * light.radius * light.radius; }

Double3 corner(const DiscLight& light, int i, int count) {
    const Double3 normal = to_double(light.normal);
    const Double3 other = std::fabs(normal.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    const Double3 x = normalized(cross(normal, other));
    const double angle = 2 * std::numbers::pi * i / count;
    return to_double(light.center) +
           light.radius * (std::cos(angle) * x + std::sin(angle) * cross(normal, x));
}

} // namespace

void Kind::add_to(const DiscLight& light, Bounds& bounds) {
    const Double3 margin = {light.radius, light.radius, light.radius};
    bounds.add(to_double(light.center) - margin);
    bounds.add(to_double(light.center) + margin);
}

void Kind::hash(const DiscLight& light, ContentHash& hash) {
    const auto& [emitter, center, normal, radius, radiance] = light;
    hash.add(emitter, center, normal, radius, radiance);
}

Double3 Kind::flux_per_emission(const DiscLight& light, double /*scene_radius*/) {
    return lambertian_flux(area_of(light));
}

void Kind::add_moment(const DiscLight& light, Moment& moment) {
    moment.add(area_of(light), to_double(light.center));
}

bool Kind::is_valid(const DiscLight& light) { return is_valid_coordinate(light.center) && light.radius > 0; }

void Kind::transform(DiscLight& light, const Transform& transform) {
    light.center = to_float(transform_point(transform, to_double(light.center)));
    light.normal = to_float(normalized(transform_normal(transform, to_double(light.normal))));
    light.radius = static_cast<float>(light.radius * std::cbrt(linear_determinant(transform)));
}

bool Kind::same_shape(const DiscLight& a, const DiscLight& b) {
    return a.center == b.center && a.normal == b.normal && a.radius == b.radius;
}

const bool* Kind::two_sided(const DiscLight& /*light*/) { return nullptr; }

void Kind::add_mesh(const DiscLight& light, LightMesh& mesh) {
    constexpr int kCorners = 64;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < kCorners; ++i) mesh.positions.push_back(to_float(corner(light, i, kCorners)));
    for (std::uint32_t i = 1; i + 1 < kCorners; ++i)
        mesh.triangles.push_back({{first, first + i, first + i + 1}});
}

double Kind::hit(const DiscLight& light, const SightRay& ray) {
    const Double3 center = to_double(light.center);
    const Double3 normal = to_double(light.normal);
    const double t = dot(center - ray.origin, normal) / dot(ray.direction, normal);
    const bool is_inside = length(ray.origin + t * ray.direction - center) <= light.radius;
    return t > 0 && is_inside ? t : std::numeric_limits<double>::infinity();
}

std::string Kind::describe(std::span<const DiscLight> lights, double /*scene_radius*/) {
    const DiscLight& light = lights.front();
    return "radius " + report_text(light.radius) + " m, " +
           power_text(lambertian_flux(area_of(light)), light.radiance);
}

std::string Kind::rig_field(const DiscLight& /*light*/) { return ""; }

} // namespace nusselt::scene
