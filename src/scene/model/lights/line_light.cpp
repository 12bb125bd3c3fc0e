#include "scene/model/lights/line_light.h"

#include "scene/model/bounds.h"
#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_text.h"
#include "scene/model/number_text.h"
#include "scene/model/transform.h"

#include <nusselt/core/frame.h>
#include <nusselt/core/trig.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nusselt::scene {

namespace {

using Kind = LightKind<LineLight>;

/// Radius of the corners of a regular polygon with the area of the unit circle.
double corner_radius() {
    const double angle = 2 * kPi<double> / kTubeSides;
    return std::sqrt(angle / std::sin(angle));
}

double axis_length(const LineLight& light) { return length(to_double(light.end) - to_double(light.start)); }

/// Of a light with a normal: perpendicular to it and to the line, of the length of the radius.
Double3 across(const LineLight& light) {
    const Double3 axis = to_double(light.end) - to_double(light.start);
    return (light.radius / length(axis)) * cross(to_double(light.normal), axis);
}

void add_rectangle(const LineLight& light, LightMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Double3 side = across(light);
    for (const Double3& corner : {to_double(light.start) - side, to_double(light.end) - side,
                                  to_double(light.end) + side, to_double(light.start) + side})
        mesh.positions.push_back(to_float(corner));
    mesh.triangles.push_back({{first, first + 1, first + 2}});
    mesh.triangles.push_back({{first, first + 2, first + 3}});
}

} // namespace

double lateral_area(const LineLight& light) {
    const double around = light.model == TubeModel::strip ? 4 : 2 * std::numbers::pi;
    return around * static_cast<double>(light.radius) * axis_length(light);
}

double area(const LineLight& light) {
    const double radius = light.radius;
    const double caps = light.model == TubeModel::solid ? 2 * std::numbers::pi * radius * radius : 0;
    return lateral_area(light) + caps;
}

void Kind::add_to(const LineLight& light, Bounds& bounds) {
    const Double3 margin = {light.radius, light.radius, light.radius};
    for (const Float3& end : {light.start, light.end}) {
        bounds.add(to_double(end) - margin);
        bounds.add(to_double(end) + margin);
    }
}

// A new member does not compile until it is listed here.
void Kind::hash(const LineLight& light, ContentHash& hash) {
    const auto& [emitter, start, end, radius, radiance, model, normal, texture, profile] = light;
    hash.add(emitter, start, end, radius, radiance, model, normal, texture, profile);
}

Double3 Kind::flux_per_emission(const LineLight& light, double /*scene_radius*/) {
    return lambertian_flux(area(light));
}

void Kind::add_moment(const LineLight& light, Moment& moment) {
    moment.add(lateral_area(light), 0.5 * (to_double(light.start) + to_double(light.end)));
}

bool Kind::is_valid(const LineLight& light) {
    return is_valid_coordinate(light.start) && is_valid_coordinate(light.end) && light.radius > 0 &&
           is_valid_coordinate({light.radius, 0, 0}) && axis_length(light) > 0 &&
           (light.model != TubeModel::strip || length(across(light)) > 0);
}

/// Radii grow with the cube root of the determinant.
void Kind::transform(LineLight& light, const Transform& transform) {
    if (!is_black(light.normal)) {
        const Double3 axis = transform_vector(transform, to_double(light.end) - to_double(light.start));
        light.normal = to_float(normalized(cross(axis, transform_vector(transform, across(light)))));
    }
    light.start = to_float(transform_point(transform, to_double(light.start)));
    light.end = to_float(transform_point(transform, to_double(light.end)));
    light.radius = static_cast<float>(light.radius * std::cbrt(std::fabs(linear_determinant(transform))));
}

bool Kind::same_shape(const LineLight& a, const LineLight& b) {
    return a.start == b.start && a.end == b.end && a.radius == b.radius && a.model == b.model &&
           a.normal == b.normal;
}

const bool* Kind::two_sided(const LineLight& /*light*/) { return nullptr; }

/// A rectangle or a closed cylinder.
void Kind::add_mesh(const LineLight& light, LightMesh& mesh) {
    if (light.model == TubeModel::strip) return add_rectangle(light, mesh);
    const auto to_vec = [](const Float3& v) { return Vec3<double>{v.x, v.y, v.z}; };
    const auto add = [&](const Vec3<double>& p) { mesh.positions.push_back(to_float({p.x, p.y, p.z})); };
    const Vec3<double> begin = to_vec(light.start);
    const Vec3<double> end = to_vec(light.end);
    const auto frame = Frame<double>::from_normal(normalize(end - begin));
    const double radius = light.radius * corner_radius();
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t side = 0; side < kTubeSides; ++side) {
        const double angle = 2 * kPi<double> * side / kTubeSides;
        const Vec3<double> offset =
            (radius * std::cos(angle)) * frame.t + (radius * std::sin(angle)) * frame.b;
        add(begin + offset);
        add(end + offset);
    }
    for (std::uint32_t side = 0; side < kTubeSides; ++side) {
        const std::uint32_t here = first + 2 * side;
        const std::uint32_t next = first + 2 * ((side + 1) % kTubeSides);
        mesh.triangles.push_back({{here, next, here + 1}});
        mesh.triangles.push_back({{next, next + 1, here + 1}});
    }
    for (std::uint32_t side = 1; side + 1 < kTubeSides; ++side) {
        const std::uint32_t here = first + 2 * side;
        mesh.triangles.push_back({{first, here + 2, here}});
        mesh.triangles.push_back({{first + 1, here + 1, here + 3}});
    }
}

/// The point of the ray that is closest to the axis.
double Kind::hit(const LineLight& light, const SightRay& ray) {
    constexpr double kMiss = std::numeric_limits<double>::infinity();
    const Double3 begin = to_double(light.start);
    const Double3 axis = to_double(light.end) - begin;
    const Double3 between = begin - ray.origin;
    const double axis_squared = dot(axis, axis);
    const double direction_squared = dot(ray.direction, ray.direction);
    const double mixed = dot(axis, ray.direction);
    const double determinant = axis_squared * direction_squared - mixed * mixed;
    double along = 0.5;
    if (determinant > 0)
        along = (mixed * dot(ray.direction, between) - direction_squared * dot(axis, between)) / determinant;
    const Double3 on_axis = begin + std::clamp(along, 0.0, 1.0) * axis;
    const double t = dot(on_axis - ray.origin, ray.direction) / direction_squared;
    if (!(t > 0)) return kMiss;
    const double distance = length(ray.origin + t * ray.direction - on_axis);
    return distance <= std::max<double>(light.radius, ray.tolerance_at(t)) ? t : kMiss;
}

namespace {

std::string width_text(const LineLight& light) {
    return light.model == TubeModel::strip ? "width " + report_text(2 * light.radius)
                                           : "radius " + report_text(light.radius);
}

std::string model_fields(TubeModel model) {
    if (model == TubeModel::linear) return "\"finite\": false";
    return std::string("\"finite\": true") + (model == TubeModel::open ? ", \"caps\": \"dark\"" : "");
}

} // namespace

std::string Kind::describe(std::span<const LineLight> lights, double /*scene_radius*/) {
    double sum = 0;
    double extent = 0;
    for (const LineLight& light : lights) {
        sum += area(light);
        extent += axis_length(light);
    }
    const LineLight& first = lights.front();
    return (lights.size() > 1 ? std::to_string(lights.size()) + " lines, " : "") + "length " +
           report_text(extent) + " m, " + width_text(first) + " m, " +
           (first.texture >= 0   ? "textured, mean radiance "
            : first.profile >= 0 ? "mean radiance "
                                 : "radiance ") +
           report_text(first.radiance) + " W/(sr m^2), " + power_text(lambertian_flux(sum), first.radiance);
}

std::string Kind::rig_field(const LineLight& light) {
    const std::string ends =
        "{\"begin\": " + triple_text(light.start) + ", \"end\": " + triple_text(light.end);
    if (light.model == TubeModel::strip)
        return "\"strip\": " + ends + ", \"normal\": " + triple_text(light.normal) +
               ", \"width\": " + number_text(2 * light.radius) + "}";
    return "\"tube\": " + ends + ", \"radius\": " + number_text(light.radius) + ", " +
           model_fields(light.model) +
           (is_black(light.normal) ? "" : ", \"normal\": " + triple_text(light.normal)) + "}";
}

} // namespace nusselt::scene
