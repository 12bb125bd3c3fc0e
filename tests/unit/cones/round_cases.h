#pragma once
/// Spheres, disks, ellipses and ellipsoids for tests, and the integral of the cosine over them by a formula that the library does
/// not use: the contour integral along the silhouette, in long double.

#include <algorithm>
#include <cmath>
#include <random>

#include <nusselt/cones/cone_ltc.h>
#include <nusselt/cones/cone_projected_solid_angle.h>
#include <nusselt/cones/cone_solid_angle.h>

#include "geometry/reference.h"

namespace nusselt_test {

enum class Shape { disk, ellipse, sphere, ellipsoid };
inline constexpr Shape kShapes[] = {Shape::disk, Shape::ellipse, Shape::sphere, Shape::ellipsoid};

/// Where a light is, in shading space. Touching ones are up to 20 large and as close as 1e-4 to the point, needles have axes of
/// 1 : 50 to 1 : 100.
enum class Place { ordinary, at_horizon, tiny, near, elongated, edge_on, touching, needle };
inline constexpr Place kPlaces[] = {Place::ordinary, Place::at_horizon, Place::tiny,
                                    Place::near,     Place::elongated,  Place::edge_on};

struct RoundLight {
    Shape shape;
    nusselt::Vec3<double> center, axis[3]; ///< perpendicular semi-axes; disks and ellipses use the first two
};

/// Calls f(light) with the light as the library has it.
template <class T, class Function>
auto with_light(const RoundLight& light, const Function& f) {
    const auto v = [](const nusselt::Vec3<double>& a) { return nusselt::broadcast<T>(a); };
    const auto size = static_cast<T>(length(light.axis[0]));
    switch (light.shape) {
    case Shape::disk:
        return f(nusselt::Disk<T>{v(light.center), normalize(v(light.axis[2])), size});
    case Shape::ellipse: // conjugate semi-diameters
        return f(nusselt::Ellipse<T>{v(light.center), v(0.8 * light.axis[0] + 0.6 * light.axis[1]),
                                     v(0.8 * light.axis[1] - 0.6 * light.axis[0])});
    case Shape::sphere:
        return f(nusselt::Sphere<T>{v(light.center), size});
    default:
        return f(
            nusselt::Ellipsoid<T>{v(light.center), {v(light.axis[0]), v(light.axis[1]), v(light.axis[2])}});
    }
}

class RandomLights {
public:
    explicit RandomLights(unsigned seed) : engine_(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * std::uniform_real_distribution<double>()(engine_);
    }
    double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    nusselt::Vec3<double> direction() {
        std::normal_distribution<double> normal;
        const double x = normal(engine_), y = normal(engine_);
        return normalize(nusselt::Vec3<double>{x, y, normal(engine_)});
    }

    /// A light whose inside does not contain the origin.
    RoundLight operator()(Shape shape, Place place) {
        for (;;) {
            const RoundLight light = any(shape, place);
            if (shape != Shape::sphere && shape != Shape::ellipsoid) return light;
            double squared = 0;
            for (const auto& a : light.axis) {
                const double share = dot(light.center, a) / dot(a, a);
                squared += share * share;
            }
            if (squared > 1.0001) return light;
        }
    }

private:
    RoundLight any(Shape shape, Place place) {
        RoundLight light{shape, direction(), {direction(), direction(), {}}};
        auto& [a, b, c] = light.axis;
        double distance = uniform(1.2, 5);
        if (place == Place::at_horizon) {
            light.center.z = uniform(-0.5, 0.5);
            distance = uniform(1.05, 3);
        }
        const double kSize = 5e-4;
        const double kAway = 40;
        if (place == Place::tiny) {
            distance = kAway;
            light.center.z = uniform(-1.2, 1.2) * kSize / kAway;
        }
        light.center = normalize(light.center);
        if (place == Place::edge_on) {
            // The last axis is the normal.
            c = normalize(normalize(cross(light.center, a)) + logarithmic(1e-4, 1e-1) * light.center);
            a = normalize(cross(c, light.center));
        } else {
            c = normalize(cross(a, b));
        }
        b = cross(c, a);
        double r[3];
        for (double& x : r) x = uniform(0.2, 1);
        if (place == Place::elongated) {
            r[0] = 1;
            r[1] = logarithmic(0.02, 0.1);
        }
        if (place == Place::needle) {
            r[0] = 1;
            r[1] = logarithmic(0.01, 0.02);
            r[2] = logarithmic(0.01, 1);
            distance = uniform(0.02, 3);
        }
        if (place == Place::touching)
            for (double& x : r) x = logarithmic(0.5, 20);
        for (int i = 0; i < 3; ++i) {
            double size = r[i];
            if (shape == Shape::sphere || (shape == Shape::disk && i == 1)) size = r[0];
            light.axis[i] = (place == Place::tiny ? size * kSize : size) * light.axis[i];
        }
        if (place == Place::near || place == Place::touching) {
            // Above a point of the inside of the disk, or outside the surface.
            const nusselt::Vec3<double> x = direction();
            const double gap = logarithmic(place == Place::near ? 1e-2 : 1e-4, 0.3);
            const bool flat = shape == Shape::disk || shape == Shape::ellipse;
            light.center = flat ? 0.8 * (x.x * a + x.y * b) + (gap / length(c)) * c
                                : (1 + gap) * (x.x * a + x.y * b + x.z * c);
        } else {
            light.center = distance * light.center;
        }
        return light;
    }

    std::mt19937_64 engine_;
};

/// The ellipse center + u cos(theta) + v sin(theta) that looks like a light.
struct Silhouette {
    Point center, u, v;
};

inline Silhouette silhouette_of(const RoundLight& light) {
    const auto point = [](const nusselt::Vec3<double>& a) { return nusselt::broadcast<long double>(a); };
    const Point center = point(light.center);
    const Point axis[] = {point(light.axis[0]), point(light.axis[1]), point(light.axis[2])};
    if (light.shape == Shape::disk || light.shape == Shape::ellipse) return {center, axis[0], axis[1]};
    // The polar plane of the origin meets an ellipsoid in its rim, an ellipse. In the space of the unit sphere it is a circle.
    Point y;
    long double* const component[] = {&y.x, &y.y, &y.z};
    for (int i = 0; i < 3; ++i) *component[i] = dot(center, axis[i]) / dot(axis[i], axis[i]);
    const long double squared = dot(y, y);
    const Point across =
        normalize(std::fabs(y.x) < std::fabs(y.y) ? Point{0, -y.z, y.y} : Point{-y.z, 0, y.x});
    const Point other = normalize(cross(y, across));
    const long double radius = std::sqrt(1 - 1 / squared);
    const auto map = [&](const Point& x) { return x.x * axis[0] + x.y * axis[1] + x.z * axis[2]; };
    return {(1 - 1 / squared) * center, radius * map(across), radius * map(other)};
}

/// The integral of the clamped cosine over the directions to the inside of an ellipse: Stokes's theorem.
inline long double projected_solid_angle_of(const Silhouette& s) {
    static const QuadratureRule rule = gauss_legendre(16);
    const long double swing = std::hypot(s.u.z, s.v.z);
    if (s.center.z <= -swing) return 0;
    const bool whole = s.center.z >= swing;
    const long double half = whole ? kPi : std::acos(-s.center.z / swing);
    const long double middle = std::atan2(s.v.z, s.u.z);
    const auto rim = [&](long double angle) {
        return s.center + std::cos(angle) * s.u + std::sin(angle) * s.v;
    };
    long double sum = 0;
    constexpr int kPanels = 96;
    for (int i = 0; i < kPanels; ++i) {
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
            const long double share = (static_cast<long double>(i) + rule.nodes[k]) / kPanels;
            const long double angle = middle + half * (2 * share - 1);
            const Point q = rim(angle);
            const Point slope = std::cos(angle) * s.v - std::sin(angle) * s.u;
            sum += rule.weights[k] / kPanels * cross(q, slope).z / dot(q, q);
        }
    }
    sum *= 2 * half;
    if (!whole) {
        // From the end of the arc to its begin along the horizon. The difference of both keeps the digits of tiny lights.
        const Point end = rim(middle + half);
        const long double swept = 2 * std::sin(half);
        const Point back = (swept * std::sin(middle)) * s.u - (swept * std::cos(middle)) * s.v;
        const Point begin = end + back;
        sum += std::atan2(end.x * back.y - end.y * back.x, end.x * begin.x + end.y * begin.y);
    }
    return std::fabs(sum) / 2;
}

/// The part of an ellipse above the horizon as the image of a rectangle: angles from the lowest to the highest point, and shares
/// across. The rectangle is [0, 1]^2.
class VisiblePart {
public:
    explicit VisiblePart(const Silhouette& s) : center_(s.center) {
        // Conjugate semi-diameters of which the first is horizontal.
        const long double swing = std::hypot(s.u.z, s.v.z);
        const long double c = swing > 0 ? s.u.z / swing : 1, d = swing > 0 ? s.v.z / swing : 0;
        across_ = c * s.v - d * s.u;
        up_ = c * s.u + d * s.v;
        lowest_ = std::asin(std::clamp(swing > 0 ? -s.center.z / swing : -1, -1.0L, 1.0L));
    }

    /// The integral of f(unit direction) with respect to solid angle over a part of the rectangle.
    template <class Function>
    long double integral(const Function& f, long double x0, long double x1, long double y0, long double y1,
                         int nodes) const {
        const QuadratureRule rule = gauss_legendre(nodes);
        const long double volume = std::fabs(dot(center_, cross(across_, up_)));
        long double sum = 0;
        for (int i = 0; i < nodes; ++i) {
            const long double angle = angle_at(y0 + (y1 - y0) * rule.nodes[static_cast<std::size_t>(i)]);
            for (int k = 0; k < nodes; ++k) {
                const long double x = x0 + (x1 - x0) * rule.nodes[static_cast<std::size_t>(k)];
                const Point q = center_ + (std::cos(angle) * (2 * x - 1)) * across_ + std::sin(angle) * up_;
                const long double distance = length(q);
                const long double area = std::cos(angle) * std::cos(angle) * 2 * (kPi / 2 - lowest_);
                sum += rule.weights[static_cast<std::size_t>(i)] * rule.weights[static_cast<std::size_t>(k)] *
                       area * volume / (distance * distance * distance) * f((1 / distance) * q);
            }
        }
        return sum * (x1 - x0) * (y1 - y0);
    }

    /// Where a direction is in the rectangle.
    nusselt::Vec2<long double> place_of(const Point& wi) const {
        // Cramer's rule for x across + y up + z center = wi.
        const long double z = dot(cross(across_, up_), wi);
        const long double x = dot(cross(up_, center_), wi) / z;
        const long double y = std::clamp(dot(cross(center_, across_), wi) / z, -1.0L, 1.0L);
        const long double half = std::sqrt(std::max(1 - y * y, 1e-30L));
        return {std::clamp((x / half + 1) / 2, 0.0L, 1.0L),
                std::clamp((std::asin(y) - lowest_) / (kPi / 2 - lowest_), 0.0L, 1.0L)};
    }

private:
    long double angle_at(long double y) const { return lowest_ + (kPi / 2 - lowest_) * y; }

    Point center_, across_, up_;
    long double lowest_;
};

} // namespace nusselt_test
