#pragma once
/// Adaptive quadrature in long double, for integrands with narrow peaks.

#include "geometry/reference.h"

namespace nusselt_test {

/// Integral of f(x, y) over the unit square, which is subdivided until the quarters of a cell agree with the cell.
template <class Integrand>
class AdaptiveSquare {
public:
    /// \param tolerance absolute error of the whole integral; 0 for the full precision of long double.
    AdaptiveSquare(const Integrand& f, long double tolerance) : f_(f), tolerance_(tolerance) {}

    long double integral() const { return refine(0, 0, 1, gauss(0, 0, 1), 0); }

private:
    static constexpr int kDeepest = 24;
    static constexpr int kNodes = 12;

    long double gauss(long double x, long double y, long double size) const {
        static const QuadratureRule rule = gauss_legendre(kNodes);
        long double sum = 0;
        for (std::size_t i = 0; i < kNodes; ++i)
            for (std::size_t j = 0; j < kNodes; ++j)
                sum += rule.weights[i] * rule.weights[j] *
                       f_(x + size * rule.nodes[i], y + size * rule.nodes[j]);
        return sum * size * size;
    }

    long double refine(long double x, long double y, long double size, long double coarse, int depth) const {
        const long double half = size / 2;
        long double quarter[4];
        long double fine = 0;
        for (int k = 0; k < 4; ++k) {
            quarter[k] = gauss(x + (k % 2) * half, y + (k / 2) * half, half);
            fine += quarter[k];
        }
        // The error of the quarters is much smaller than their difference from the whole.
        if (depth == kDeepest ||
            std::fabs(fine - coarse) <= std::max(tolerance_ * size, 1e-16L * std::fabs(fine)))
            return fine;
        long double sum = 0;
        for (int k = 0; k < 4; ++k)
            sum += refine(x + (k % 2) * half, y + (k / 2) * half, half, quarter[k], depth + 1);
        return sum;
    }

    const Integrand& f_;
    long double tolerance_;
};

template <class Integrand>
long double integrate_square(const Integrand& f, long double tolerance) {
    return AdaptiveSquare<Integrand>(f, tolerance).integral();
}

/// Integral of f(wi) over the solid angle of a convex polygon. f must be smooth on it.
template <class Integrand>
long double integrate_solid_angle(const Polygon& polygon, const Integrand& f, long double tolerance) {
    long double sum = 0;
    for (std::size_t j = 1; j + 1 < polygon.size(); ++j) {
        const Point a = polygon[j] - polygon[0];
        const Point b = polygon[j + 1] - polygon[0];
        const Point doubled_area = cross(a, b);
        const auto over_triangle = [&](long double s, long double t) {
            const Point p = polygon[0] + (s * (1 - t)) * a + (s * t) * b;
            const long double r = length(p);
            return s * f((1 / r) * p) * std::fabs(dot(doubled_area, p)) / (r * r * r);
        };
        sum += integrate_square(over_triangle, tolerance);
    }
    return sum;
}

/// Integral of f(wi) over the solid angle per radius of a line, by the angle about the origin, to the cosine of which
/// the width of a thin cylinder is proportional. f must be smooth on it.
template <class Integrand>
long double integrate_per_radius(const Segment& line, const Integrand& f) {
    constexpr int kPanels = 400;
    const Point s = normalize(line.end - line.begin);
    const Point closest = line.begin - dot(line.begin, s) * s;
    const long double distance = length(closest);
    const auto angle = [&](const Point& p) { return std::atan2(dot(p, s), distance); };
    const long double begin = angle(line.begin);
    const long double panel = (angle(line.end) - begin) / kPanels;
    const QuadratureRule rule = gauss_legendre(24);
    long double sum = 0;
    for (int i = 0; i < kPanels; ++i) {
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
            const long double alpha = begin + (i + rule.nodes[k]) * panel;
            const Point wi = std::sin(alpha) * s + (std::cos(alpha) / distance) * closest;
            sum += rule.weights[k] * 2 * std::cos(alpha) * f(wi);
        }
    }
    return sum * panel / distance;
}

} // namespace nusselt_test
