#pragma once
/// References for tests, in long double. They are written to be obviously correct, not fast or robust, and use
/// formulas other than those of the library.

#include <cmath>
#include <vector>

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/line_segment.h>

namespace nusselt_test {

using Point = nusselt::Vec3<long double>;
using Polygon = std::vector<Point>;

inline constexpr long double kPi = 3.141592653589793238462643383279502884L;

struct QuadratureRule {
    std::vector<long double> nodes, weights; ///< on [0, 1]
};

/// Gauss-Legendre rule with the given number of nodes, by Newton's method on the Legendre polynomial.
inline QuadratureRule gauss_legendre(int count) {
    QuadratureRule rule;
    for (int i = 0; i < count; ++i) {
        long double x = std::cos(kPi * (i + 0.75L) / (count + 0.5L));
        long double slope = 0;
        for (int iteration = 0; iteration < 20; ++iteration) {
            long double previous = 1;
            long double value = x;
            for (int k = 2; k <= count; ++k) {
                const long double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
                previous = value;
                value = next;
            }
            slope = count * (x * value - previous) / (x * x - 1);
            x -= value / slope;
        }
        rule.nodes.push_back((1 + x) / 2);
        rule.weights.push_back(1 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

/// Integral of f(p) over the area of a convex polygon. Each triangle of a fan is the image of a square.
template <class Integrand>
long double integrate(const Polygon& polygon, const Integrand& f, int nodes_per_axis = 48) {
    const QuadratureRule rule = gauss_legendre(nodes_per_axis);
    long double sum = 0;
    for (std::size_t j = 1; j + 1 < polygon.size(); ++j) {
        const Point a = polygon[j] - polygon[0];
        const Point b = polygon[j + 1] - polygon[0];
        const long double doubled_area = length(cross(a, b));
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
            for (std::size_t l = 0; l < rule.nodes.size(); ++l) {
                const long double s = rule.nodes[k];
                const long double t = rule.nodes[l];
                const Point p = polygon[0] + (s * (1 - t)) * a + (s * t) * b;
                sum += rule.weights[k] * rule.weights[l] * doubled_area * s * f(p);
            }
        }
    }
    return sum;
}

/// Integral of f(p) over the length of a segment.
template <class Integrand>
long double integrate(const Point& begin, const Point& end, const Integrand& f, int nodes = 200) {
    const QuadratureRule rule = gauss_legendre(nodes);
    long double sum = 0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        sum += rule.weights[k] * f(begin + rule.nodes[k] * (end - begin));
    }
    return sum * length(end - begin);
}

/// The part of a convex polygon where dot(normal, p) >= 0, without repeated vertices.
inline Polygon cut(const Polygon& polygon, const Point& normal) {
    Polygon result;
    for (std::size_t j = 0; j < polygon.size(); ++j) {
        const Point& a = polygon[j];
        const Point& b = polygon[(j + 1) % polygon.size()];
        const long double above_a = dot(normal, a);
        const long double above_b = dot(normal, b);
        if (above_a >= 0 && length(b - a) > 0) result.push_back(a);
        if ((above_a > 0 && above_b < 0) || (above_a < 0 && above_b > 0)) {
            result.push_back(a + (above_a / (above_a - above_b)) * (b - a));
        }
    }
    return result;
}

struct Segment {
    Point begin, end;
};

/// The part of a segment where dot(normal, p) >= 0.
inline Segment cut(Segment line, const Point& normal) {
    const long double begin = dot(normal, line.begin);
    const long double end = dot(normal, line.end);
    const Point crossing = line.begin + (begin / (begin - end)) * (line.end - line.begin);
    if (begin < 0) line.begin = crossing;
    if (end < 0) line.end = crossing;
    return line;
}

inline Polygon above_horizon(const Polygon& polygon) { return cut(polygon, {0, 0, 1}); }

/// Projected solid angle of a polygon above the horizon, by Lambert's sum over the edges.
inline long double lambert(const Polygon& polygon) {
    long double sum = 0;
    for (std::size_t j = 0; j < polygon.size(); ++j) {
        const Point& a = polygon[j];
        const Point& b = polygon[(j + 1) % polygon.size()];
        const Point n = cross(a, b);
        const long double sine = length(n);
        if (sine > 0) sum += n.z / sine * std::atan2(sine, dot(a, b));
    }
    return std::fabs(sum) / 2;
}

/// Solid angle of a convex polygon by Girard's theorem: the excess of the sum of the interior angles.
inline long double girard(const Polygon& polygon) {
    const std::size_t count = polygon.size();
    if (count < 3) return 0;
    long double excess = -(static_cast<long double>(count) - 2) * kPi;
    for (std::size_t j = 0; j < count; ++j) {
        const Point& here = polygon[j];
        const Point before = cross(here, polygon[(j + count - 1) % count]);
        const Point after = cross(here, polygon[(j + 1) % count]);
        excess += std::atan2(length(cross(before, after)), dot(before, after));
    }
    return excess;
}

template <class T, int N>
Polygon vertices_of(const nusselt::ConvexPolygon<T, N>& polygon) {
    Polygon result;
    for (const auto& v : polygon.vertex) {
        const Point p = nusselt::broadcast<long double>(v);
        if (result.empty() || length(p - result.back()) > 0) result.push_back(p);
    }
    return result;
}

template <class T>
Point widened_begin(const nusselt::LineSegment<T>& line) {
    return nusselt::broadcast<long double>(line.p0);
}
template <class T>
Point widened_end(const nusselt::LineSegment<T>& line) {
    return widened_begin(line) +
           static_cast<long double>(line.length) * nusselt::broadcast<long double>(line.s);
}

} // namespace nusselt_test
