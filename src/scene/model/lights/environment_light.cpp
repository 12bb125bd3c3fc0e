#include "scene/model/lights/environment_light.h"

#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_text.h"
#include "scene/model/transform.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace nusselt::scene {

namespace {

using Kind = LightKind<EnvironmentLight>;

bool has_portal(const EnvironmentLight& light) { return light.portal.size() > 0; }

/// The portal as a light that emits to both sides: most of what lights can be asked is the same.
PolygonLight portal_of(const EnvironmentLight& light) {
    return {.vertices = light.portal, .radiance = light.radiance, .two_sided = true};
}

} // namespace

// A new member does not compile until it is listed here.
void Kind::hash(const EnvironmentLight& light, ContentHash& hash) {
    const auto& [emitter, map, radiance, x_axis, y_axis, z_axis, portal] = light;
    hash.add(emitter, map, radiance, x_axis, y_axis, z_axis);
    hash.add(portal.size());
    for (const Float3& vertex : portal) hash.add(vertex);
}

Double3 Kind::flux_per_emission(const EnvironmentLight& light, double scene_radius) {
    if (has_portal(light)) return lambertian_flux(area(portal_of(light)));
    const double area = 4 * std::numbers::pi * scene_radius * scene_radius;
    return {std::numbers::pi * area, std::numbers::pi * area, std::numbers::pi * area};
}

void Kind::add_moment(const EnvironmentLight& light, Moment& moment) {
    if (has_portal(light))
        LightKind<PolygonLight>::add_moment(portal_of(light), moment);
    else
        moment.add(1, {});
}

bool Kind::is_valid(const EnvironmentLight& light) {
    const Double3 x = to_double(light.x_axis);
    const Double3 y = to_double(light.y_axis);
    const Double3 z = to_double(light.z_axis);
    constexpr double kRounding = 1e-5;
    if (has_portal(light) && !LightKind<PolygonLight>::is_valid(portal_of(light))) return false;
    return std::fabs(std::fabs(dot(cross(x, y), z)) - 1) <= kRounding;
}

/// Of the transform, only rotation and reflection count for the map.
void Kind::transform(EnvironmentLight& light, const Transform& transform) {
    const auto moved = [&](const Float3& axis) { return transform_vector(transform, to_double(axis)); };
    for (Float3& vertex : light.portal) vertex = to_float(transform_point(transform, to_double(vertex)));
    const Double3 z = normalized(moved(light.z_axis));
    const Double3 x_moved = moved(light.x_axis);
    const Double3 x = normalized(x_moved - dot(x_moved, z) * z);
    const double side = dot(cross(z, x), moved(light.y_axis));
    light.x_axis = to_float(x);
    light.y_axis = to_float((side < 0 ? -1.0 : 1.0) * cross(z, x));
    light.z_axis = to_float(z);
}

bool Kind::same_shape(const EnvironmentLight& a, const EnvironmentLight& b) {
    const auto is_near = [](const Float3& p, const Float3& q) {
        return length(to_double(p) - to_double(q)) <= 1e-6;
    };
    return a.map == b.map && LightKind<PolygonLight>::same_shape(portal_of(a), portal_of(b)) &&
           is_near(a.x_axis, b.x_axis) && is_near(a.y_axis, b.y_axis) && is_near(a.z_axis, b.z_axis);
}

/// Nobody can point at it.
double Kind::hit(const EnvironmentLight& /*light*/, const SightRay& /*ray*/) {
    return std::numeric_limits<double>::infinity();
}

std::string Kind::describe(std::span<const EnvironmentLight> lights, double scene_radius) {
    const EnvironmentLight& first = lights.front();
    const auto count = static_cast<double>(lights.size());
    const std::string portal =
        has_portal(first) ? "portal of " + report_text(area(portal_of(first))) + " m^2, " : "";
    return portal + (first.map < 0 ? "radiance " : "map, mean radiance ") + report_text(first.radiance) +
           " W/(sr m^2), " + power_text(count * flux_per_emission(first, scene_radius), first.radiance) +
           (has_portal(first) ? " through the portal" : " into the radius of the scene");
}

} // namespace nusselt::scene
