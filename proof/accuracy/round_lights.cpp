#include "proof/accuracy/lights.h"

#include <cmath>
#include <random>

namespace nusselt::proof {

namespace {

using Vec = Vec3<double>;

double uniform(Engine& engine, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
}
double logarithmic(Engine& engine, double low, double high) {
    return std::exp(uniform(engine, std::log(low), std::log(high)));
}
Vec direction(Engine& engine) {
    const double z = uniform(engine, -1, 1);
    const double angle = uniform(engine, 0, 2 * kPi<double>);
    const double sine = std::sqrt(1 - z * z);
    return {sine * std::cos(angle), sine * std::sin(angle), z};
}
Vec above(Engine& engine) {
    const Vec v = direction(engine);
    return {v.x, v.y, std::fabs(v.z)};
}

/// Perpendicular semi-axes of given lengths around a centre, the last one along a normal.
Ellipsoid<float> ellipsoid(Engine& engine, const Vec& center, const Vec& normal, double a, double b,
                           double c) {
    const Vec u = normalize(cross(normal, direction(engine)));
    const Vec v = cross(normal, u);
    const auto rounded = [](const Vec& x) { return broadcast<float>(x); };
    return {rounded(center), {rounded(a * u), rounded(b * v), rounded(c * normal)}};
}
Ellipsoid<float> around(Engine& engine, const Vec& center, double smallest, double largest) {
    const double a = uniform(engine, smallest, largest), b = uniform(engine, smallest, largest);
    return ellipsoid(engine, center, direction(engine), a, b, uniform(engine, smallest, largest));
}

/// At a height that the light exceeds.
Ellipsoid<float> crossing(Engine& engine) {
    const Vec d =
        normalize(Vec{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -0.15, 0.15)});
    return around(engine, uniform(engine, 1.2, 2) * d, 0.4, 0.8);
}

} // namespace

const std::vector<RoundClass>& round_classes() {
    static const std::vector<RoundClass> classes = {
        {"above", Visibility::everyone,
         [](Engine& e) {
             const Vec center = {uniform(e, -1, 1), uniform(e, -1, 1), uniform(e, 1.2, 3)};
             return around(e, center, 0.2, 1);
         }},
        {"crossing the horizon", Visibility::everyone, crossing},
        {"1 mm at 40 m", Visibility::everyone,
         [](Engine& e) {
             const Vec d = normalize(above(e) + Vec{0, 0, 0.1});
             return around(e, 40.0 * d, 2e-4, 1e-3);
         }},
        {"1 cm at 2 m, crossing the horizon", Visibility::everyone,
         [](Engine& e) {
             const double angle = uniform(e, 0, 2 * kPi<double>);
             const Vec center{2 * std::cos(angle), 2 * std::sin(angle), uniform(e, -2e-3, 2e-3)};
             return around(e, center, 5e-3, 1e-2);
         }},
        {"large and close", Visibility::everyone,
         [](Engine& e) {
             // Above the inside of the disk, and outside the ellipsoid.
             const double c = logarithmic(e, 1e-3, 1e-1);
             const double a = uniform(e, 2, 8), b = a * uniform(e, 0.5, 1);
             return ellipsoid(e, {0, 0, c * uniform(e, 1.1, 3)}, normalize(Vec{0.2, 0.1, 1}), a, b, c);
         }},
        {"1 : 50", Visibility::everyone,
         [](Engine& e) {
             const Vec center = uniform(e, 1.5, 3) * normalize(above(e) + Vec{0, 0, 0.5});
             return ellipsoid(e, center, direction(e), 1, 0.02, 0.1);
         }},
        {"edge-on up to 1e-3", Visibility::everyone,
         [](Engine& e) {
             const Vec d = normalize(above(e) + Vec{0, 0, 0.5});
             const Vec normal = normalize(normalize(cross(d, direction(e))) + logarithmic(e, 1e-3, 1e-2) * d);
             return ellipsoid(e, uniform(e, 1.5, 3) * d, normal, 0.5, 0.4, 0.3);
         }},
        {"below the horizon", Visibility::no_one_above_horizon,
         [](Engine& e) {
             const Vec center = {uniform(e, -1, 1), uniform(e, -1, 1), -1.1};
             return around(e, center, 0.2, 0.6);
         }},
        {"no extent", Visibility::no_one,
         [](Engine& e) { return ellipsoid(e, above(e), direction(e), 0, 0, 0); }},
    };
    return classes;
}

} // namespace nusselt::proof
