#pragma once
/// Integrals of a density over lights of finite thickness and over linear lights, by the midpoint rule: to validate the
/// analytic shading of ltc/line_shading.h. E. Heitz, S. Hill 2017, Linear-Light Shading with Linearly Transformed
/// Cosines, Eq. 1.2, 1.6 and 1.29. Deviations: surfaces shine on one side only, and midpoints instead of end points,
/// whose error goes with the square of the step.
///
/// In all functions density(wi) is a function of a unit direction in the space of the light [1/sr], 0 where the
/// surface receives nothing. Scalars only.

#include <cmath>

#include <nusselt/core/trig.h>
#include <nusselt/geometry/line_segment.h>

NUSSELT_NAMESPACE_BEGIN

/// The integral over a linear light in the limit of a thin tube, per radius [1/m].
/// \param steps along the light.
template <class Real, class Density>
Real reference_line_integral(const LineSegment<Real>& light, const Density& density, int steps) noexcept {
    const Real step = light.length / static_cast<Real>(steps);
    Real sum = 0;
    for (int i = 0; i < steps; ++i) {
        const Vec3<Real> p = light.p0 + (static_cast<Real>(i) + Real(0.5)) * step * light.s;
        const Vec3<Real> wi = normalize(p);
        sum += density(wi) * 2 * length(cross(wi, light.s)) / dot(p, p);
    }
    return sum * step;
}

/// The integral over the lateral surface of a tube, without its end caps.
/// \param light  the axis [m]; the origin is outside the tube.
/// \param radius [m]
/// \param around, along steps around the tube and along it.
template <class Real, class Density>
Real reference_tube_integral(const LineSegment<Real>& light, Real radius, const Density& density, int around,
                             int along) noexcept {
    const Frame<Real> frame = Frame<Real>::from_normal(light.s);
    const Real turn = 2 * kPi<Real> / static_cast<Real>(around);
    const Real step = light.length / static_cast<Real>(along);
    Real sum = 0;
    for (int i = 0; i < around; ++i) {
        const Real angle = (static_cast<Real>(i) + Real(0.5)) * turn;
        const Vec3<Real> normal = std::cos(angle) * frame.t + std::sin(angle) * frame.b;
        for (int j = 0; j < along; ++j) {
            const Vec3<Real> p =
                light.p0 + (static_cast<Real>(j) + Real(0.5)) * step * light.s + radius * normal;
            const Vec3<Real> wi = normalize(p);
            sum += density(wi) * max(-dot(wi, normal), Real(0)) / dot(p, p);
        }
    }
    return sum * radius * turn * step;
}

/// The integral over the end caps of a tube.
/// \param light  the axis [m]; the origin is outside the tube.
/// \param radius [m]
/// \param around, outward steps around the axis and away from it.
template <class Real, class Density>
Real reference_caps_integral(const LineSegment<Real>& light, Real radius, const Density& density, int around,
                             int outward) noexcept {
    const Frame<Real> frame = Frame<Real>::from_normal(light.s);
    const Real turn = 2 * kPi<Real> / static_cast<Real>(around);
    const Real step = radius / static_cast<Real>(outward);
    Real sum = 0;
    for (int i = 0; i < around; ++i) {
        const Real angle = (static_cast<Real>(i) + Real(0.5)) * turn;
        const Vec3<Real> across = std::cos(angle) * frame.t + std::sin(angle) * frame.b;
        for (int j = 0; j < outward; ++j) {
            const Real r = (static_cast<Real>(j) + Real(0.5)) * step;
            for (const Real end : {Real(0), Real(1)}) {
                const Vec3<Real> p = light.p0 + end * light.length * light.s + r * across;
                const Vec3<Real> wi = normalize(p);
                const Real cosine = (1 - 2 * end) * dot(wi, light.s);
                sum += r * density(wi) * max(cosine, Real(0)) / dot(p, p);
            }
        }
    }
    return sum * turn * step;
}

/// The integral over a rectangle, both sides of which shine.
/// \param light  the middle line [m].
/// \param normal of the rectangle, unit, perpendicular to the line.
/// \param width  [m]
/// \param across, along steps across the line and along it.
template <class Real, class Density>
Real reference_strip_integral(const LineSegment<Real>& light, const Vec3<Real>& normal, Real width,
                              const Density& density, int across, int along) noexcept {
    const Vec3<Real> sideways = cross(normal, light.s);
    const Real side_step = width / static_cast<Real>(across);
    const Real step = light.length / static_cast<Real>(along);
    Real sum = 0;
    for (int i = 0; i < across; ++i) {
        const Real side = (static_cast<Real>(i) + Real(0.5)) * side_step - Real(0.5) * width;
        for (int j = 0; j < along; ++j) {
            const Vec3<Real> p =
                light.p0 + (static_cast<Real>(j) + Real(0.5)) * step * light.s + side * sideways;
            const Vec3<Real> wi = normalize(p);
            sum += density(wi) * abs(dot(wi, normal)) / dot(p, p);
        }
    }
    return sum * side_step * step;
}

NUSSELT_NAMESPACE_END
