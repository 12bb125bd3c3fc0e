#pragma once
/// Starts and iterations that find an azimuth within a sector, in the simplest form, to look at how they converge: those of
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, Sec. 3.3 and 3.4, and of J. Arvo 2001 (Sec. 3.8 there).

#include <nusselt/core/vec.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nusselt::lab {

/// The part of the unit disk between two ellipses, which are projected great circles, for azimuths from 0 to `sweep`.
template <class Real>
struct TwoEllipses {
    using Point = Vec2<Real>;

    Real sweep;         ///< [rad], below pi
    Point inner, outer; ///< u of the ellipses with the matrices I + u u^T

    /// Great circles by the tangents of their elevations at both ends.
    static TwoEllipses between(Real sweep, const Vec2<Real>& inner, const Vec2<Real>& outer) {
        const auto ellipse = [&](const Vec2<Real>& elevations) {
            const Vec3<Real> n = cross(Vec3<Real>{1, 0, elevations.x},
                                       Vec3<Real>{std::cos(sweep), std::sin(sweep), elevations.y});
            return Point{n.x / n.z, n.y / n.z};
        };
        return {sweep, ellipse(inner), ellipse(outer)};
    }

    static Point towards(Real azimuth) { return {std::cos(azimuth), std::sin(azimuth)}; }
    /// a^T (I + u u^T) b.
    static Real form(const Point& u, const Point& a, const Point& b) {
        return dot(a, b) + dot(u, a) * dot(u, b);
    }
    /// Where an ellipse ends in a direction.
    static Point reach(const Point& u, Real azimuth) {
        const Point w = towards(azimuth);
        return (1 / std::sqrt(form(u, w, w))) * w;
    }
    /// The area of an ellipse up to an azimuth between -pi and pi (Eq. 1).
    static Real area_within(const Point& u, Real azimuth) {
        const Real root = std::sqrt(1 + dot(u, u));
        const Point begin{1, 0};
        const Point w = towards(azimuth);
        return std::atan2(root * w.y, form(u, begin, w)) / (2 * root);
    }

    /// The area up to an azimuth, also beyond the sector.
    Real area_to(Real azimuth) const { return area_within(outer, azimuth) - area_within(inner, azimuth); }
    Real area() const { return area_to(sweep); }
    /// The derivative of area_to().
    Real density(Real azimuth) const {
        const Point w = towards(azimuth);
        return (1 / form(outer, w, w) - 1 / form(inner, w, w)) / 2;
    }
    /// The random number that a point explains.
    Real share_to(Real azimuth) const { return area_to(azimuth) / area(); }

    /// The azimuth up to which a function that rises from 0 has a value.
    template <class Rising>
    Real bisect(const Rising& rising, Real value) const {
        Real low = 0;
        Real high = sweep;
        for (int i = 0; i < 80; ++i) {
            const Real middle = (low + high) / 2;
            (rising(middle) < value ? low : high) = middle;
        }
        return (low + high) / 2;
    }
    Real exact_azimuth(Real share) const {
        return bisect([&](Real azimuth) { return area_to(azimuth); }, share * area());
    }

    /// Sec. 3.4, with any number of quads whose sides are at equal azimuths.
    Real start_with_quads(int quads, Real share) const {
        const auto triangle_to = [&](const Point& a, const Point& b, Real azimuth) {
            // The triangle of the origin, a, and the point of the line through a and b at the azimuth.
            const Point w = towards(azimuth);
            const auto det = [](const Point& p, const Point& q) { return p.x * q.y - p.y * q.x; };
            const Point side = b - a;
            return det(a, (det(a, side) / det(w, side)) * w) / 2;
        };
        const auto area_of_quads_to = [&](Real azimuth) {
            Real sum = 0;
            for (int k = 0; k < quads; ++k) {
                const Real begin = sweep * static_cast<Real>(k) / static_cast<Real>(quads);
                const Real end = sweep * static_cast<Real>(k + 1) / static_cast<Real>(quads);
                if (azimuth <= begin) break;
                const Real to = std::min(azimuth, end);
                sum += triangle_to(reach(outer, begin), reach(outer, end), to) -
                       triangle_to(reach(inner, begin), reach(inner, end), to);
            }
            return sum;
        };
        return bisect(area_of_quads_to, share * area_of_quads_to(sweep));
    }

    /// The polynomial of Arvo through the shares at four azimuths.
    Real start_with_cubic(Real share) const {
        Real sum = 0;
        std::array<Real, 4> node, value;
        for (std::size_t i = 0; i < 4; ++i) {
            value[i] = sweep * static_cast<Real>(i) / 3;
            node[i] = share_to(value[i]);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            Real term = value[i];
            for (std::size_t k = 0; k < 4; ++k)
                if (k != i) term *= (share - node[k]) / (node[i] - node[k]);
            sum += term;
        }
        return sum;
    }

    /// A step of Newton's method.
    Real newton_step(Real azimuth, Real share) const {
        return azimuth - (area_to(azimuth) - share * area()) / density(azimuth);
    }

    /// A step of Sec. 3.3: the area between the tangents of both ellipses makes up for the error. With w = w_n + t R w_n, Eq. 5
    /// is a quadratic equation for t, of which the root next to 0 is wanted.
    Real tangent_step(Real azimuth, Real share) const {
        const Point w = towards(azimuth);
        const Point turned{-w.y, w.x};
        const Real missing = 2 * (share * area() - area_to(azimuth));
        const Real ao = form(outer, w, w), bo = form(outer, w, turned);
        const Real ai = form(inner, w, w), bi = form(inner, w, turned);
        const Real a = (bi - bo) - missing * bo * bi;
        const Real b = (ai - ao) - missing * (ao * bi + ai * bo);
        const Real c = -missing * ao * ai;
        const Real root = std::sqrt(std::max(b * b - 4 * a * c, Real(0)));
        return azimuth + std::atan(-2 * c / (b + root));
    }
};

} // namespace nusselt::lab
