#include "scene/model/lights/environment_light.h"

#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_text.h"
#include "scene/model/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nusselt::scene {

namespace {

using Kind = LightKind<EnvironmentLight>;

} // namespace

// A new member does not compile until it is listed here.
void Kind::hash(const EnvironmentLight& light, ContentHash& hash) {
    const auto& [emitter, map, radiance, x_axis, y_axis, z_axis, portal] = light;
    hash.add(emitter, map, radiance, x_axis, y_axis, z_axis);
    hash.add(portal.size());
    for (const Float3& vertex : portal) hash.add(vertex);
}

Double3 Kind::flux_per_emission(const EnvironmentLight& /*light*/, double scene_radius) {
    const double area = 4 * std::numbers::pi * scene_radius * scene_radius;
    return {std::numbers::pi * area, std::numbers::pi * area, std::numbers::pi * area};
}

void Kind::add_moment(const EnvironmentLight& /*light*/, Moment& moment) { moment.add(1, {}); }

bool Kind::is_valid(const EnvironmentLight& light) {
    const Double3 x = to_double(light.x_axis);
    const Double3 y = to_double(light.y_axis);
    const Double3 z = to_double(light.z_axis);
    constexpr double kRounding = 1e-5;
    return std::fabs(std::fabs(dot(cross(x, y), z)) - 1) <= kRounding;
}

/// Only the rotation and the reflection of the transform count.
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
    return a.map == b.map && std::equal(a.portal.begin(), a.portal.end(), b.portal.begin(), b.portal.end()) &&
           is_near(a.x_axis, b.x_axis) && is_near(a.y_axis, b.y_axis) && is_near(a.z_axis, b.z_axis);
}

/// Nobody can point at it.
double Kind::hit(const EnvironmentLight& /*light*/, const SightRay& /*ray*/) {
    return std::numeric_limits<double>::infinity();
}

std::string Kind::describe(std::span<const EnvironmentLight> lights, double scene_radius) {
    const EnvironmentLight& first = lights.front();
    const auto count = static_cast<double>(lights.size());
    return std::string(first.portal.size() > 0 ? "portal, " : "") +
           (first.map < 0 ? "radiance " : "map, mean radiance ") + report_text(first.radiance) +
           " W/(sr m^2), " + power_text(count * flux_per_emission(first, scene_radius), first.radiance) +
           " into the radius of the scene";
}

} // namespace nusselt::scene
