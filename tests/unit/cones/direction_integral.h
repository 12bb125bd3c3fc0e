#pragma once
/// Integrals over the directions to a light, in polar coordinates whose range comes from an equation that techniques do not use
/// (proof/hostile/round_reference.h).

#include <algorithm>
#include <cmath>

#include <nusselt/sampling/piecewise_linear.h>

#include "geometry/reference.h"
#include "proof/hostile/round_reference.h"

namespace nusselt_test {

/// Integral of a function by halves, as far as they differ from the whole.
/// \param depth the number of halvings that are left.
template <class Function>
long double adaptive_integral(const Function& f, long double begin, long double end, long double tolerance,
                              int depth) {
    static const QuadratureRule rule = gauss_legendre(10);
    const auto over = [&](long double a, long double b) {
        long double sum = 0;
        for (std::size_t k = 0; k < rule.nodes.size(); ++k)
            sum += rule.weights[k] * f(a + (b - a) * rule.nodes[k]);
        return sum * (b - a);
    };
    const auto refine = [&](const auto& self, long double a, long double b, long double whole,
                            int left) -> long double {
        const long double middle = (a + b) / 2;
        const long double low = over(a, middle), high = over(middle, b);
        if (left == 0 || std::fabs(low + high - whole) <= tolerance) return low + high;
        return self(self, a, middle, low, left - 1) + self(self, middle, b, high, left - 1);
    };
    return refine(refine, begin, end, over(begin, end), depth);
}

/// The directions to a light, above the plane z = 0 or all of them. Directions are cos(gamma) pole + sin(gamma) (cos(beta) first +
/// sin(beta) second), from the pole to the rim.
class DirectionRegion {
public:
    enum class Part { all, above_horizon };

    template <class Light>
    DirectionRegion(const Light& light, Part part) : form_(nusselt::hostile::ray_form_of(light)) {
        const auto contour = nusselt::hostile::contour_of(light);
        const long double swing = std::hypot(contour.u.z, contour.v.z);
        is_empty_ = form_.is_dark || (part == Part::above_horizon && contour.center.z <= -swing);
        is_cut_ = part == Part::above_horizon && std::fabs(contour.center.z) < swing;
        if (is_empty_) return;
        if (is_cut_) {
            // In the middle of both ends of the horizon's arc. Techniques have corners along the lines from there.
            const long double middle = std::atan2(contour.v.z, contour.u.z);
            const long double half = std::acos(-contour.center.z / swing);
            const auto end = [&](long double angle) {
                const auto p = contour.center + std::cos(angle) * contour.u + std::sin(angle) * contour.v;
                return normalize(Point{p.x, p.y, 0});
            };
            pole_ = normalize(end(middle - half) + end(middle + half));
            contour_ = contour;
            begin_ = middle - half;
            end_ = middle + half;
            first_ = {-pole_.y, pole_.x, 0};
            second_ = {0, 0, 1};
        } else {
            turn_to_axes(contour);
        }
    }

    bool is_empty() const { return is_empty_; }
    bool is_cut() const { return is_cut_; }

    /// \param density function of a unit direction.
    /// \param tolerance of the integral, which is of order one.
    template <class Density>
    long double integral(const Density& density, long double tolerance) const {
        static const QuadratureRule rule = gauss_legendre(10);
        if (is_empty_) return 0;
        const auto towards = [&](const Point& away) {
            const long double rim = rim_towards(away);
            long double sum = 0;
            for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
                const long double gamma = rim * rule.nodes[k];
                sum += rule.weights[k] * std::sin(gamma) *
                       density(std::cos(gamma) * pole_ + std::sin(gamma) * away);
            }
            return sum * rim;
        };
        const auto along = [&](long double angle) {
            // The direction of an angle in the ellipse that is the projection along the pole.
            const long double x = std::cos(angle), y = squeeze_ * std::sin(angle), squared = x * x + y * y;
            return towards(1 / std::sqrt(squared) * (x * first_ + y * second_)) * squeeze_ / squared;
        };
        if (is_cut_) {
            // By the point of the contour to which a half-plane leads: thin lights are no peaks then.
            const auto along_contour = [&](long double angle) {
                const long double c = std::cos(angle), s = std::sin(angle);
                const Point rim = contour_.center + c * contour_.u + s * contour_.v;
                const Point slope = c * contour_.v - s * contour_.u;
                const long double x = dot(first_, rim), z = std::max(rim.z, 0.0L), squared = x * x + z * z;
                if (!(squared > 0)) return 0.0L;
                const long double turn = (x * slope.z - z * dot(first_, slope)) / squared;
                return std::fabs(turn) * towards(1 / std::sqrt(squared) * (x * first_ + z * second_));
            };
            return adaptive_integral(along_contour, begin_, (begin_ + end_) / 2, tolerance / 2, 30) +
                   adaptive_integral(along_contour, (begin_ + end_) / 2, end_, tolerance / 2, 30);
        }
        // Corners of linear interpolants are ends of panels.
        using Nodes = nusselt::PiecewiseLinear<long double, 8>;
        long double sum = 0;
        for (int quadrant = 0; quadrant < 4; ++quadrant) {
            for (int i = 0; i < 7; ++i) {
                const auto end = [&](int node) {
                    const long double x = Nodes::node(quadrant % 2 == 0 ? node : 7 - node);
                    return kPi / 2 * (static_cast<long double>(quadrant) + (quadrant % 2 == 0 ? x : 1 - x));
                };
                sum += adaptive_integral(along, end(i), end(i + 1), tolerance / 28, 30);
            }
        }
        return sum;
    }

private:
    /// Takes the axes of symmetry of the cone, where linear interpolants have their corners: the eigenvectors of
    /// u u^T + v v^T - c c^T, by Jacobi's method.
    void turn_to_axes(const nusselt::hostile::Contour& contour) {
        const Point column[] = {contour.u, contour.v, contour.center};
        const auto entry = [&](const auto& x, const auto& y) {
            return x(column[0]) * y(column[0]) + x(column[1]) * y(column[1]) - x(column[2]) * y(column[2]);
        };
        const auto x = [](const Point& p) { return p.x; };
        const auto y = [](const Point& p) { return p.y; };
        const auto z = [](const Point& p) { return p.z; };
        long double m[3][3] = {{entry(x, x), entry(x, y), entry(x, z)},
                               {entry(x, y), entry(y, y), entry(y, z)},
                               {entry(x, z), entry(y, z), entry(z, z)}};
        long double vectors[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int sweep = 0; sweep < 12; ++sweep) {
            for (int p = 0; p < 2; ++p) {
                for (int q = p + 1; q < 3; ++q) {
                    if (m[p][q] == 0) continue;
                    const long double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                    const long double t =
                        std::copysign(1 / (std::fabs(theta) + std::hypot(theta, 1.0L)), theta);
                    const long double c = 1 / std::hypot(t, 1.0L), s = t * c;
                    for (int k = 0; k < 3; ++k) {
                        const long double a = m[k][p], b = m[k][q];
                        m[k][p] = c * a - s * b;
                        m[k][q] = s * a + c * b;
                    }
                    for (int k = 0; k < 3; ++k) {
                        const long double a = m[p][k], b = m[q][k];
                        m[p][k] = c * a - s * b;
                        m[q][k] = s * a + c * b;
                        const long double v = vectors[k][p], w = vectors[k][q];
                        vectors[k][p] = c * v - s * w;
                        vectors[k][q] = s * v + c * w;
                    }
                }
            }
        }
        int least = 0;
        for (int k = 1; k < 3; ++k)
            if (m[k][k] < m[least][least]) least = k;
        const auto vector = [&](int k) {
            return normalize(Point{vectors[0][k], vectors[1][k], vectors[2][k]});
        };
        const int one = (least + 1) % 3, two = (least + 2) % 3;
        pole_ = vector(least);
        if (dot(pole_, contour.center) < 0) pole_ = -pole_;
        first_ = vector(one);
        second_ = cross(pole_, first_);
        const auto squared_sine = [&](int k) { return m[k][k] / (m[k][k] - m[least][least]); };
        const long double ratio = squared_sine(two) / squared_sine(one);
        squeeze_ = ratio > 0 && std::isfinite(ratio) ? std::sqrt(ratio) : 1;
    }

    /// The angle from the pole at which directions leave the light.
    long double rim_towards(const Point& away) const {
        const long double here = form_(pole_, pole_), half = form_(pole_, away), there = form_(away, away);
        const long double root = std::sqrt(std::max(half * half - here * there, 0.0L));
        return half > 0 ? std::atan2(-here, half + root) : std::atan2(root - half, there);
    }

    nusselt::hostile::RayForm form_;
    nusselt::hostile::Contour contour_;
    long double begin_ = 0, end_ = 0; ///< angles of the contour above the horizon, if that cuts it
    Point pole_, first_, second_;
    long double squeeze_ = 1; ///< the second semi-axis of the projection over the first one
    bool is_empty_, is_cut_;
};

} // namespace nusselt_test
