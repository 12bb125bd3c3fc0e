#pragma once
/// Integrals over the part of a cone between two horizons, by the half-planes around the line in which they meet: their angle
/// is the variable, and where they meet the cone is a quadratic equation for each of them.

#include <algorithm>
#include <cmath>
#include <vector>

#include "cones/direction_integral.h"

namespace nusselt_test {

/// The directions to an ellipse above z = 0 and above a second plane through the y-axis.
class LuneRegion {
public:
    /// \param contour an ellipse.
    /// \param normal  of the second plane, (x, 0, z).
    template <class Contour>
    LuneRegion(const Contour& contour, const Point& normal)
        : rows_{cross(contour.v, contour.center), cross(contour.center, contour.u),
                cross(contour.u, contour.v)},
          volume_(dot(contour.u, rows_[0])),
          side_(normal.x < 0 ? -1 : 1),
          end_(std::atan2(std::fabs(normal.x), -normal.z)) {}

    /// \param density   function of a unit direction.
    /// \param tolerance of the integral, which is of order one.
    template <class Density>
    long double integral(const Density& density, long double tolerance) const {
        static const QuadratureRule rule = gauss_legendre(24);
        const auto within = [&](long double beta) {
            const Point axis{0, 1, 0}, away = away_at(beta);
            const Point v = in_cone(axis), d = in_cone(away);
            // The form is middle + swing cos(2 gamma - turn), and negative in the cone.
            const long double vv = form(v, v), dd = form(d, d), vd = form(v, d);
            const long double middle = (vv + dd) / 2, swing = std::hypot((vv - dd) / 2, vd);
            const long double turn = std::atan2(-vd, (dd - vv) / 2);
            const long double share = middle / swing;
            if (share >= 1) return 0.0L;
            const long double half = std::acos(std::max(share, -1.0L)) / 2;
            long double sum = 0;
            for (int k = -1; k <= 2; ++k) {
                const long double center = turn / 2 + static_cast<long double>(k) * kPi;
                const long double low = std::max(center - half, 0.0L), high = std::min(center + half, kPi);
                if (!(low < high)) continue;
                const long double gamma = (low + high) / 2;
                if (!(std::cos(gamma) * v.z + std::sin(gamma) * d.z > 0)) continue;
                for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                    const long double at = low + (high - low) * rule.nodes[i];
                    sum += rule.weights[i] * (high - low) * std::sin(at) *
                           density(std::cos(at) * axis + std::sin(at) * away);
                }
            }
            return sum;
        };
        // Half-planes that touch the cone are ends of panels: the discriminant is one of 2 beta.
        const long double first = discriminant(0), second = discriminant(kPi / 2);
        const long double mean = (first + second) / 2, x = (first - second) / 2,
                          y = discriminant(kPi / 4) - mean;
        std::vector<long double> ends{0, end_};
        const long double share = -mean / std::hypot(x, y);
        if (std::fabs(share) < 1) {
            for (const long double sign : {-1.0L, 1.0L}) {
                const long double touch = (std::atan2(y, x) + sign * std::acos(share)) / 2;
                for (const long double beta : {touch - kPi, touch, touch + kPi})
                    if (0 < beta && beta < end_) ends.push_back(beta);
            }
        }
        std::sort(ends.begin(), ends.end());
        long double sum = 0;
        for (std::size_t i = 0; i + 1 < ends.size(); ++i)
            sum += adaptive_integral(within, ends[i], ends[i + 1], tolerance / 4, 40);
        return sum;
    }

private:
    Point away_at(long double beta) const { return {side_ * std::cos(beta), 0, std::sin(beta)}; }
    /// Positive if the plane at an angle cuts the cone.
    long double discriminant(long double beta) const {
        const Point v = in_cone({0, 1, 0}), d = in_cone(away_at(beta));
        return form(v, d) * form(v, d) - form(v, v) * form(d, d);
    }
    /// A direction as s u + t v + w center.
    Point in_cone(const Point& wi) const {
        return (1 / volume_) * Point{dot(rows_[0], wi), dot(rows_[1], wi), dot(rows_[2], wi)};
    }
    static long double form(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y - a.z * b.z; }

    Point rows_[3];
    long double volume_, side_, end_;
};

} // namespace nusselt_test
