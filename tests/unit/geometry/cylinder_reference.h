#pragma once
/// Integrals over the directions to a closed cylinder, in long double: by area over the parts of its surface that
/// face the origin. As the cylinder is convex, the origin sees all of these and no others.

#include <nusselt/geometry/cylinder.h>

#include "geometry/adaptive_quadrature.h"

namespace nusselt_test {

struct SolidCylinder {
    Point begin, end;
    long double radius;

    Point axis() const { return normalize(end - begin); }
};

template <class T>
SolidCylinder solid(const nusselt::Cylinder<T>& cylinder) {
    return {widened_begin(cylinder.axis), widened_end(cylinder.axis), cylinder.radius};
}

/// Integral of f(wi) over the solid angle of a cylinder. The integrand may have kinks; the quadrature adapts to them.
/// \param tolerance absolute error of the integral over each part of the surface.
template <class Integrand>
long double integrate_solid_angle(const SolidCylinder& cylinder, const Integrand& f, long double tolerance) {
    const Point s = cylinder.axis();
    const long double along = dot(cylinder.begin, s);
    const Point closest = cylinder.begin - along * s;
    const long double distance = length(closest);
    // The directions away from the origin and across. On the axis, any pair will do.
    const Point away =
        distance > 0 ? (1 / distance) * closest : nusselt::Frame<long double>::from_normal(s).t;
    const Point across = cross(s, away);
    const auto weighted = [&](const Point& p, const Point& normal) {
        const long double r = length(p);
        const Point wi = (1 / r) * p;
        return f(wi) * std::max(-dot(normal, wi), 0.0L) / (r * r);
    };
    const auto outwards = [&](long double angle) {
        return std::cos(angle) * away + std::sin(angle) * across;
    };

    long double sum = 0;
    const long double extent = length(cylinder.end - cylinder.begin);
    if (distance > cylinder.radius) {
        // The lateral surface faces the origin between the tangent planes. The axis is cut into pieces because it may
        // be long and close.
        const long double half_angle = std::acos(cylinder.radius / distance);
        const auto over_lateral_surface = [&](long double l0, long double l1) {
            return integrate_square(
                [&](long double x, long double y) {
                    const Point normal = outwards(kPi + half_angle * (2 * x - 1));
                    const Point p = closest + (l0 + (l1 - l0) * y) * s + cylinder.radius * normal;
                    return weighted(p, normal) * 2 * half_angle * cylinder.radius * (l1 - l0);
                },
                tolerance / 16);
        };
        for (int i = 0; i < 16; ++i)
            sum += over_lateral_surface(along + extent * i / 16, along + extent * (i + 1) / 16);
    }
    const auto over_cap = [&](const Point& middle, const Point& normal) {
        return integrate_square(
            [&](long double x, long double y) {
                const Point p = middle + (cylinder.radius * x) * outwards(2 * kPi * y);
                return weighted(p, normal) * 2 * kPi * cylinder.radius * cylinder.radius * x;
            },
            tolerance);
    };
    if (along > 0) sum += over_cap(cylinder.begin, -s);
    if (along + extent < 0) sum += over_cap(cylinder.end, s);
    return sum;
}

} // namespace nusselt_test
