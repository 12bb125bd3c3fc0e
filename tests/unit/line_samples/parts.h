#pragma once
/// Random planar lights in the frame of a shading point, and integrals along their lines in long double.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <nusselt/line_samples/shading.h>

#include "geometry/reference.h"
#include "proof/hostile/lights.h"

namespace nusselt_test {

using nusselt::hostile::RandomSource;

/// A convex polygon with vertices on an ellipse.
/// \param distance of its centre from the origin.
/// \param size     of the larger half-axis.
template <class T, int N>
nusselt::ConvexPolygon<T, N> ellipse_polygon(RandomSource& random, int vertices, double distance,
                                             double size) {
    using Vec = nusselt::Vec3<double>;
    Vec normal = random.direction();
    const Vec tangent = normalize(cross(normal, random.direction()));
    const Vec bitangent = cross(normal, tangent);
    const Vec centre = distance * random.direction();
    const double aspect = random.between(0.2, 1);
    const double start = random.between(0, 6.28);
    nusselt::Vec3<T> corner[N];
    for (int j = 0; j < vertices; ++j) {
        const double angle = start + 6.283185307179586 * (j + random.between(0, 0.8)) / vertices;
        corner[j] = nusselt::broadcast<T>(centre + (size * std::cos(angle)) * tangent +
                                          (size * aspect * std::sin(angle)) * bitangent);
    }
    return nusselt::make_polygon<N>(corner, vertices);
}

template <class T>
Point to_point(const nusselt::Vec3<T>& v) {
    return nusselt::broadcast<long double>(v);
}

/// Integral of f(p) along an interval of a line [m], refined until it no longer changes.
template <class Integrand>
long double integrate_along(const Point& origin, const Point& along, long double begin, long double end,
                            const Integrand& f) {
    static const QuadratureRule rule = gauss_legendre(24);
    const auto panel = [&](long double a, long double b) {
        long double sum = 0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i)
            sum += rule.weights[i] * f(origin + (a + (b - a) * rule.nodes[i]) * along);
        return sum * (b - a);
    };
    const auto refine = [&](const auto& self, long double a, long double b, long double coarse,
                            long double whole, int depth) -> long double {
        const long double middle = (a + b) / 2;
        const long double left = panel(a, middle);
        const long double right = panel(middle, b);
        if (depth == 60 || std::fabs(left + right - coarse) <= 1e-16L * std::max(whole, left + right))
            return left + right;
        return self(self, a, middle, left, std::max(whole, left + right), depth + 1) +
               self(self, middle, b, right, std::max(whole, left + right), depth + 1);
    };
    return refine(refine, begin, end, panel(begin, end), 0, 0);
}

template <class T>
nusselt::LinePlane<long double> widened(const nusselt::LinePlane<T>& plane) {
    return {to_point(plane.origin), to_point(plane.across), to_point(plane.along), to_point(plane.normal)};
}

/// A part of a line of a one-sided light, in long double.
class ExactPart {
public:
    template <class T>
    ExactPart(const nusselt::LinePlane<T>& plane, T offset, const nusselt::Interval<T>& part)
        : plane_(widened(plane)),
          origin_(plane_.origin + static_cast<long double>(offset) * plane_.across),
          splits_{part.begin, part.end} {
        // Integrands are smooth but vary fast around the point closest to the origin.
        const long double closest = -dot(origin_, plane_.along);
        const long double distance = length(origin_ + closest * plane_.along);
        split_around(closest, distance, 100);
        split_at({0, 0, 1});
    }

    /// Splits the line for an integrand that is not smooth where the line crosses this plane through the origin.
    void split_at(const Point& normal) { split(-dot(origin_, normal) / dot(plane_.along, normal)); }

    /// Splits the line for an integrand with a peak in a direction.
    /// \param width of the peak [rad].
    void split_at_peak(const Point& direction, long double width) {
        const Point closest = origin_ - dot(origin_, plane_.along) * plane_.along;
        const long double distance = length(closest);
        const long double toward = dot(direction, closest) / distance;
        if (toward <= 0) return;
        const long double peak = distance * dot(direction, plane_.along) / toward;
        split_around(peak - dot(origin_, plane_.along), width * distance / (toward * toward), 20);
    }

    /// Integral of f(wi) cos(light) / distance^2 along the part.
    template <class Integrand>
    long double integral(const Integrand& f) const {
        long double sum = 0;
        for (std::size_t k = 0; k + 1 < splits_.size(); ++k)
            sum += integrate_along(origin_, plane_.along, splits_[k], splits_[k + 1], [&](const Point& p) {
                const long double r = length(p);
                const Point wi = (1 / r) * p;
                return f(wi) * std::max(-dot(wi, plane_.normal), 0.0L) / (r * r);
            });
        return sum;
    }

private:
    void split(long double t) {
        if (t > splits_.front() && t < splits_.back()) {
            splits_.push_back(t);
            std::sort(splits_.begin(), splits_.end());
        }
    }
    void split_around(long double t, long double width, long double reach) {
        split(t);
        for (long double step = width / 2; step <= reach * width; step *= 2) {
            split(t - step);
            split(t + step);
        }
    }

    nusselt::LinePlane<long double> plane_;
    Point origin_;
    std::vector<long double> splits_; ///< coordinates, by increasing value
};

/// A random part of a random line of a random light.
template <class T>
struct RandomPart {
    nusselt::ConvexPolygon<T, 8> light;
    nusselt::LineFamily<T, 8> family;
    T offset;
    nusselt::Interval<T> whole, part;

    RandomPart(RandomSource& random, int vertices, double distance, double size)
        : light(ellipse_polygon<T, 8>(random, vertices, distance, size)),
          family(light, static_cast<T>(random.between(0, 3.14159))),
          offset(family.sample_by_length(static_cast<T>(random.uniform())).offset),
          whole(family.chord(offset).extent) {
        const auto at = [&](double share) {
            return whole.begin + static_cast<T>(share) * (whole.end - whole.begin);
        };
        const double a = random.uniform();
        const double b = random.uniform();
        part = {at(std::min(a, b)), at(std::max(a, b))};
    }

    nusselt::ScaledPlane<T> scaled_plane() const { return {family.plane(), family.reach()}; }

    /// The line as Lambertian surfaces see it.
    template <class Sides = nusselt::FrontSide>
    nusselt::LobeLine<T> cosine() const {
        return nusselt::LobePlane<T, Sides>(scaled_plane()).line(offset);
    }

    ExactPart exact(const nusselt::Interval<T>& interval) const { return {family.plane(), offset, interval}; }

    /// A point of the line.
    Point point(double share) const {
        return to_point(
            nusselt::segment_of(family.plane(), offset,
                                {whole.begin + static_cast<T>(share) * (whole.end - whole.begin), whole.end})
                .p0);
    }
};

} // namespace nusselt_test
