#pragma once
/// Spheres, disks, ellipses and ellipsoids in long double, what a point sees of them, and the angle by which a direction misses
/// them. Of the library, this takes the vectors and the structures of lights only.

#include <algorithm>
#include <cmath>
#include <limits>

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

/// A unit vector perpendicular to another one.
inline Vec3<long double> across(const Vec3<long double>& n) {
    return normalize(std::fabs(n.x) < std::fabs(n.y) ? Vec3<long double>{0, n.z, -n.y}
                                                     : Vec3<long double>{n.z, 0, -n.x});
}
inline Ellipse<long double> as_ellipse(const Disk<long double>& light) {
    const auto u = across(light.normal);
    return {light.center, light.radius * u, light.radius * cross(light.normal, u)};
}
inline const Ellipse<long double>& as_ellipse(const Ellipse<long double>& light) { return light; }
inline const Ellipsoid<long double>& as_ellipsoid(const Ellipsoid<long double>& light) { return light; }
inline Ellipsoid<long double> as_ellipsoid(const Sphere<long double>& light) {
    const long double r = light.radius;
    return {light.center, {{r, 0, 0}, {0, r, 0}, {0, 0, r}}};
}

/// \name What a ray from the origin meets, by solving for its coordinates: nothing here is shared with the cones of techniques.
/// @{

/// A linear map by its rows.
struct RoundRows {
    Vec3<long double> row[3];

    Vec3<long double> operator()(const Vec3<long double>& v) const {
        return {dot(row[0], v), dot(row[1], v), dot(row[2], v)};
    }
};

/// Cramer's rule: coordinates in the basis a, b, c, times the determinant.
inline RoundRows coordinates_in(const Vec3<long double>& a, const Vec3<long double>& b,
                                const Vec3<long double>& c) {
    return {{cross(b, c), cross(c, a), cross(a, b)}};
}

/// The cone of rays to a light, as a quadratic form that is negative on them and on their opposites.
struct RayForm {
    RoundRows to_light; ///< flat: coordinates along u, v and the centre; else the space of the unit sphere
    Vec3<long double> center; ///< of the unit sphere
    bool is_flat;
    bool is_dark;   ///< no ray meets the light
    bool is_around; ///< all rays do, or all to one side of a plane light

    long double operator()(const Vec3<long double>& a, const Vec3<long double>& b) const {
        const auto p = to_light(a), q = to_light(b);
        if (is_flat) return p.x * q.x + p.y * q.y - p.z * q.z;
        return dot(cross(center, p), cross(center, q)) - dot(p, q);
    }
    bool is_ahead(const Vec3<long double>& a) const {
        const auto p = to_light(a);
        return (is_flat ? p.z : dot(center, p)) > 0;
    }
    bool contains(const Vec3<long double>& a) const {
        const auto p = to_light(a);
        if (!is_ahead(a)) return false;
        return is_flat ? std::hypot(p.x, p.y) <= p.z : length(cross(center, p)) <= length(p);
    }
};

inline RayForm ray_form_of(const Ellipse<long double>& light) {
    RayForm form{coordinates_in(light.u, light.v, light.center), {}, true, false, false};
    const auto area = cross(light.u, light.v);
    const long double volume = dot(area, light.center);
    if (volume < 0)
        for (auto& row : form.to_light.row) row = -row;
    form.is_dark = !(length(area) > 0);
    if (volume == 0 && !form.is_dark) {
        // The origin in the plane: in the ellipse or beside it.
        const auto in_plane = coordinates_in(light.u, light.v, area)(light.center);
        const long double determinant = dot(area, area);
        form.is_around = std::hypot(in_plane.x, in_plane.y) < determinant;
        form.is_dark = !form.is_around;
    }
    return form;
}
inline RayForm ray_form_of(const Disk<long double>& light) { return ray_form_of(as_ellipse(light)); }
inline RayForm ray_form_of(const Ellipsoid<long double>& light) {
    const auto& axis = light.axis;
    RayForm form{coordinates_in(axis[0], axis[1], axis[2]), {}, false, false, false};
    const long double volume = dot(axis[0], form.to_light.row[0]);
    form.is_dark = volume == 0;
    if (form.is_dark) return form;
    for (auto& row : form.to_light.row) row = (1 / volume) * row;
    form.center = form.to_light(light.center);
    form.is_around = dot(form.center, form.center) < 1;
    return form;
}
inline RayForm ray_form_of(const Sphere<long double>& light) { return ray_form_of(as_ellipsoid(light)); }
/// @}

/// The smallest angle between a unit direction and one that leads to a light [rad]; 0 if the direction itself does, 1 for lights
/// that no direction within a right angle leads to.
template <template <class> class Shape>
long double round_miss(const Shape<long double>& light, const Vec3<long double>& wi) {
    using Exact = long double;
    const RayForm form = ray_form_of(light);
    if (form.is_around) return 0;
    if (form.is_dark) return 1;
    if (form.contains(wi)) return 0;
    // In the plane that touches the sphere of directions at wi, the light is convex. Along any line from wi, it begins at a
    // root of a quadratic equation. As a function of the angle of the line, this has one minimum, to both sides of the line
    // to the centre.
    const Vec3<Exact> towards = light.center - dot(light.center, wi) * wi;
    if (!(length(towards) > 0)) return 1;
    const Vec3<Exact> along = normalize(towards), aside = cross(wi, along);
    const Exact here = form(wi, wi);
    const auto tangent_at = [&](Exact angle) {
        const Vec3<Exact> e = std::cos(angle) * along + std::sin(angle) * aside;
        const Exact half = form(wi, e), square = form(e, e), discriminant = half * half - square * here;
        const Exact root = std::sqrt(std::max(discriminant, Exact(0)));
        // From the opposite of the light, a line leaves that first.
        const Exact numerator = here > 0 ? here : half + root;
        const Exact denominator = here > 0 ? root - half : -square;
        const bool meets = discriminant >= 0 && numerator > 0 && denominator > 0;
        const Exact tangent = meets ? numerator / denominator : 0;
        return meets && form.is_ahead(wi + tangent * e) ? tangent : std::numeric_limits<Exact>::infinity();
    };
    constexpr Exact kQuarterTurn = 1.57079632679489661923L;
    Exact low = -kQuarterTurn, high = kQuarterTurn, middle = 0, least = tangent_at(0);
    for (int i = 0; i < 160; ++i) {
        // Half of the larger part, alternately: the smallest of three values stays in the middle.
        const bool left = middle - low > high - middle;
        const Exact tried = left ? (low + middle) / 2 : (middle + high) / 2;
        const Exact value = tangent_at(tried);
        if (value < least) {
            (left ? high : low) = middle;
            middle = tried;
            least = value;
        } else {
            (left ? low : high) = tried;
        }
    }
    return std::isfinite(least) ? std::atan(least) : 1;
}

/// The ellipse center + u cos(t) + v sin(t) that looks like a light from the origin, which is outside of the light.
struct Contour {
    Vec3<long double> center, u, v;
};

inline Contour contour_of(const Ellipse<long double>& light) { return {light.center, light.u, light.v}; }
inline Contour contour_of(const Disk<long double>& light) { return contour_of(as_ellipse(light)); }
/// The polar circle of the origin in the space of the unit sphere, where rays touch it.
inline Contour contour_of(const Ellipsoid<long double>& light) {
    const RayForm form = ray_form_of(light);
    const auto& y = form.center;
    const long double distance = length(y);
    const auto f = across(y);
    const auto g = normalize(cross(y, f));
    const long double squared = (distance - 1) * (distance + 1) / (distance * distance);
    const long double radius = std::sqrt(squared);
    const auto to_world = [&](const Vec3<long double>& x) {
        return radius * (x.x * light.axis[0] + x.y * light.axis[1] + x.z * light.axis[2]);
    };
    return {squared * light.center, to_world(f), to_world(g)};
}
inline Contour contour_of(const Sphere<long double>& light) { return contour_of(as_ellipsoid(light)); }

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
    return hit_point(as_ellipsoid(light), wi);
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
