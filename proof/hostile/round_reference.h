#pragma once
/// Spheres, disks, ellipses and ellipsoids in long double, and the angle by which a direction misses them.

#include <algorithm>
#include <cmath>

#include <nusselt/cones/round_lights.h>

NUSSELT_NAMESPACE_BEGIN
namespace hostile {

/// \name The light that rounded numbers describe.
/// @{
template <class Real>
Sphere<long double> exact_light(const Sphere<Real>& light) {
    return {broadcast<long double>(light.center), light.radius};
}
template <class Real>
Disk<long double> exact_light(const Disk<Real>& light) {
    return {broadcast<long double>(light.center), normalize(broadcast<long double>(light.normal)),
            light.radius};
}
template <class Real>
Ellipse<long double> exact_light(const Ellipse<Real>& light) {
    return {broadcast<long double>(light.center), broadcast<long double>(light.u),
            broadcast<long double>(light.v)};
}
template <class Real>
Ellipsoid<long double> exact_light(const Ellipsoid<Real>& light) {
    return {broadcast<long double>(light.center),
            {broadcast<long double>(light.axis[0]), broadcast<long double>(light.axis[1]),
             broadcast<long double>(light.axis[2])}};
}
/// @}

/// The smallest angle between a unit direction and one that leads to a light [rad]; 0 if the direction itself does, 1 for lights
/// that no direction leads to.
template <template <class> class Shape>
long double round_miss(const Shape<long double>& light, const Vec3<long double>& wi) {
    using Exact = long double;
    const auto view = view_of(light, nusselt::detail::SameSpace());
    const auto& cone = view.cone;
    if (static_cast<bool>(view.is_open())) return 0;
    if (!cone.is_visible || !(std::min(cone.a, cone.b) > 0)) return 1;
    const Exact s = dot(wi, cone.e1) / cone.a, t = dot(wi, cone.e2) / cone.b, height = dot(wi, cone.e3);
    if (cone.c * std::hypot(s, t) <= height) return 0;
    // The angle to the rim as a function of the angle in the disk has one minimum in the half around the direction.
    constexpr Exact kQuarterTurn = 1.57079632679489661923L;
    const Exact middle = std::atan2(t, s);
    Exact low = middle - kQuarterTurn, high = middle + kQuarterTurn;
    const auto angle_to = [&](Exact angle) {
        const Vec3<Exact> rim = normalize(cone.direction({std::cos(angle), std::sin(angle)}));
        return std::atan2(length(cross(rim, wi)), dot(rim, wi));
    };
    for (int i = 0; i < 60; ++i) {
        const Exact left = low + (high - low) / 3, right = high - (high - low) / 3;
        (angle_to(left) < angle_to(right) ? high : low) = angle_to(left) < angle_to(right) ? right : left;
    }
    return angle_to((low + high) / 2);
}

/// Where a ray from the origin meets a light, or would meet it but for rounding: the closer point, or from inside the only one.
inline Vec3<long double> hit_point(const Ellipsoid<long double>& light, const Vec3<long double>& wi) {
    const Vec3<long double> rows[] = {cross(light.axis[1], light.axis[2]),
                                      cross(light.axis[2], light.axis[0]),
                                      cross(light.axis[0], light.axis[1])};
    const long double volume = dot(light.axis[0], rows[0]);
    const auto to_sphere = [&](const Vec3<long double>& v) {
        return (1 / volume) * Vec3<long double>{dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    };
    const auto y = to_sphere(light.center), d = to_sphere(wi);
    const long double half = dot(y, d), power = dot(y, y) - 1;
    const long double root = std::sqrt(std::max(half * half - dot(d, d) * power, 0.0L));
    return power < 0 ? (half + root) / dot(d, d) * wi : power / (half + root) * wi;
}
inline Vec3<long double> hit_point(const Sphere<long double>& light, const Vec3<long double>& wi) {
    const long double r = light.radius;
    return hit_point(Ellipsoid<long double>{light.center, {{r, 0, 0}, {0, r, 0}, {0, 0, r}}}, wi);
}
inline Vec3<long double> hit_point(const Disk<long double>& light, const Vec3<long double>& wi) {
    return dot(light.normal, light.center) / dot(light.normal, wi) * wi;
}
inline Vec3<long double> hit_point(const Ellipse<long double>& light, const Vec3<long double>& wi) {
    const auto normal = cross(light.u, light.v);
    return dot(normal, light.center) / dot(normal, wi) * wi;
}

/// The longest semi-diameter of those that describe a light.
inline long double size_of(const Sphere<long double>& light) { return light.radius; }
inline long double size_of(const Disk<long double>& light) { return light.radius; }
inline long double size_of(const Ellipse<long double>& light) {
    return std::max(length(light.u), length(light.v));
}
inline long double size_of(const Ellipsoid<long double>& light) {
    return std::max({length(light.axis[0]), length(light.axis[1]), length(light.axis[2])});
}

} // namespace hostile
NUSSELT_NAMESPACE_END
