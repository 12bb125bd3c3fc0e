#include "scene/model/lights/point_light.h"

#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_text.h"
#include "scene/model/number_text.h"
#include "scene/model/profiles/luminaire.h"
#include "scene/model/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nusselt::scene {

namespace {

using Kind = LightKind<PointLight>;

/// 1 - cosine, also of tiny angles.
double one_minus_cosine(double degrees) {
    const double sine = std::sin(degrees * (std::numbers::pi / 360));
    return 2 * sine * sine;
}

/// Whether directions agree up to the rounding of files.
bool nearly_equal(const Float3& a, const Float3& b) {
    constexpr double kRounding = 1e-6;
    return length(to_double(a) - to_double(b)) <= kRounding;
}

std::string describe_distribution(const PointLight& light) {
    switch (light.distribution) {
    case PointDistribution::isotropic:
        break;
    case PointDistribution::smooth_cone:
    case PointDistribution::quartic_cone:
        return "spot of " + report_text(light.cone_angle) + " degrees, fully bright up to " +
               report_text(light.full_angle);
    case PointDistribution::octahedral_image:
    case PointDistribution::latitude_image:
        return "goniometric";
    case PointDistribution::profile:
        return "luminaire";
    case PointDistribution::projected_image: {
        const auto degrees = [](float half) { return std::atan(half) * (360 / std::numbers::pi); };
        return "projects " + report_text(degrees(light.half_extent.x)) + " x " +
               report_text(degrees(light.half_extent.y)) + " degrees";
    }
    }
    return "isotropic";
}

} // namespace

bool is_cone(PointDistribution distribution) {
    return distribution == PointDistribution::smooth_cone || distribution == PointDistribution::quartic_cone;
}

bool is_image(PointDistribution distribution) {
    return distribution == PointDistribution::octahedral_image ||
           distribution == PointDistribution::latitude_image ||
           distribution == PointDistribution::projected_image;
}

ConeFalloff cone_falloff(const PointLight& light) {
    const double end = one_minus_cosine(light.cone_angle);
    return {end, end - one_minus_cosine(light.full_angle)};
}

float inverse_width(const ConeFalloff& falloff) {
    constexpr double kSharp = 1e30;
    return static_cast<float>(std::min(1 / falloff.width, kSharp));
}

void set_profile(const Luminaire& luminaire, PointLight& light) {
    light.distribution = PointDistribution::profile;
    const double peak = luminaire.profile.peak().candelas;
    const double integral = peak > 0 ? luminaire.profile.flux() / peak : 0;
    light.image_integral = to_float(Double3{integral, integral, integral});
}

/// A zone of the sphere has an area in proportion to its height, so the border counts by the mean of its falloff.
Double3 solid_angle(const PointLight& light) {
    if (is_image(light.distribution) || light.distribution == PointDistribution::profile)
        return to_double(light.image_integral);
    double heights = 2;
    if (is_cone(light.distribution)) {
        const ConeFalloff falloff = cone_falloff(light);
        const double mean = light.distribution == PointDistribution::smooth_cone ? 1.0 / 2 : 1.0 / 5;
        heights = falloff.end - (1 - mean) * falloff.width;
    }
    const double angle = 2 * std::numbers::pi * heights;
    return {angle, angle, angle};
}

// A new member does not compile until it is listed here.
void Kind::hash(const PointLight& light, ContentHash& hash) {
    const auto& [emitter, position, intensity, distribution, x_axis, y_axis, z_axis, cone_angle, full_angle,
                 profile, texture, half_extent, image_integral] = light;
    hash.add(emitter, position, intensity, distribution, x_axis, y_axis, z_axis, cone_angle, full_angle,
             profile, texture, half_extent, image_integral);
}

Double3 Kind::flux_per_emission(const PointLight& light, double /*scene_radius*/) {
    return solid_angle(light);
}

void Kind::add_moment(const PointLight& light, Moment& moment) { moment.add(1, to_double(light.position)); }

bool Kind::is_valid(const PointLight& light) { return is_valid_coordinate(light.position); }

void Kind::transform(PointLight& light, const Transform& transform) {
    light.position = to_float(transform_point(transform, to_double(light.position)));
    for (Float3* const axis : {&light.x_axis, &light.y_axis, &light.z_axis})
        *axis = to_float(normalized(transform_vector(transform, to_double(*axis))));
}

/// The axes of a light that is isotropic, and the azimuth of one that is round, mean nothing.
bool Kind::same_shape(const PointLight& a, const PointLight& b) {
    if (a.distribution != b.distribution || a.position != b.position) return false;
    if (a.distribution == PointDistribution::isotropic) return true;
    if (!nearly_equal(a.z_axis, b.z_axis)) return false;
    if (is_cone(a.distribution)) return a.cone_angle == b.cone_angle && a.full_angle == b.full_angle;
    return nearly_equal(a.x_axis, b.x_axis) && nearly_equal(a.y_axis, b.y_axis) && a.texture == b.texture &&
           a.profile == b.profile && a.half_extent.x == b.half_extent.x && a.half_extent.y == b.half_extent.y;
}

/// The point of the ray next to the light.
double Kind::hit(const PointLight& light, const SightRay& ray) {
    constexpr double kMiss = std::numeric_limits<double>::infinity();
    const Double3 way = to_double(light.position) - ray.origin;
    const double t = dot(way, ray.direction) / dot(ray.direction, ray.direction);
    if (!(t > 0)) return kMiss;
    // A ray through the light itself is found in spite of rounding.
    const double tolerance = ray.tolerance_at(t) + 1e-6 * length(way);
    return length(t * ray.direction - way) <= tolerance ? t : kMiss;
}

std::string Kind::describe(std::span<const PointLight> lights, double /*scene_radius*/) {
    Double3 flux;
    for (const PointLight& light : lights) flux = flux + solid_angle(light);
    const PointLight& first = lights.front();
    return (lights.size() > 1 ? std::to_string(lights.size()) + " points, " : "") +
           describe_distribution(first) + ", intensity " + report_text(first.intensity) + " W/sr, " +
           power_text(flux, first.intensity);
}

std::string Kind::rig_field(const PointLight& light) {
    if (light.distribution == PointDistribution::isotropic)
        return "\"point\": " + triple_text(light.position);
    if (!is_cone(light.distribution)) return "";
    return "\"spot\": {\"position\": " + triple_text(light.position) +
           ", \"direction\": " + triple_text(light.z_axis) +
           ", \"degrees\": " + number_text(light.cone_angle) +
           ", \"full_degrees\": " + number_text(light.full_angle) +
           (light.distribution == PointDistribution::quartic_cone ? ", \"falloff\": \"quartic\"" : "") + "}";
}

} // namespace nusselt::scene
