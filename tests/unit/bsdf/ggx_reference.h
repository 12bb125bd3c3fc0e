#pragma once
/// GGX by the formulas of the textbooks, in long double.

#include "geometry/adaptive_quadrature.h"

namespace nusselt_test {

/// Densities of the directions into which visible normals reflect wo.
struct GgxReference {
    Point wo;
    long double alpha;

    long double distribution(const Point& m) const {
        const long double tan2 = (m.x * m.x + m.y * m.y) / (m.z * m.z);
        const long double root = 1 + tan2 / (alpha * alpha);
        return 1 / (kPi * alpha * alpha * m.z * m.z * m.z * m.z * root * root);
    }
    long double lambda(const Point& w) const {
        const long double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
        return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
    }
    /// The density of all visible normals [1/sr], anywhere on the sphere.
    long double pdf(const Point& wi) const {
        if (wi.z <= -wo.z) return 0;
        const Point m = normalize(wo + wi);
        const long double visible = distribution(m) * dot(wo, m) / ((1 + lambda(wo)) * wo.z);
        return visible / (4 * dot(wo, m));
    }
    /// The quotient G2 / G1 of joint shadowing and masking by masking alone.
    long double masking_weight(const Point& wi) const {
        return (1 + lambda(wo)) / (1 + lambda(wo) + lambda(wi));
    }
    /// The density of the normals in the bounded cap [1/sr]. \param wi above the surface.
    long double bounded_pdf(const Point& wi) const {
        const Point stretched = normalize(Point{alpha * wo.x, alpha * wo.y, wo.z});
        const long double s = 1 + std::sqrt(wo.x * wo.x + wo.y * wo.y);
        const long double a2 = alpha * alpha;
        const long double k = (1 - a2) * s * s / (s * s + a2 * wo.z * wo.z);
        return pdf(wi) * (1 + stretched.z) / (1 + k * stretched.z);
    }
};

/// Integral of f(wi) over directions above a plane z = lowest. The nodes are denser near that plane and opposite to
/// wo, where half vectors change fast if wo is close to the horizon.
/// \param tolerance absolute error of the integral
template <class Integrand>
long double integrate_directions(const Point& wo, long double lowest, const Integrand& f,
                                 long double tolerance = 1e-7L) {
    const long double opposite = std::atan2(-wo.y, -wo.x);
    const auto over_square = [&](long double u, long double v) {
        const long double s = 2 * u - 1;
        const long double phi = opposite + kPi * s * s * s;
        const long double z = lowest + (1 - lowest) * v * v;
        const long double r = std::sqrt(1 - z * z);
        const long double jacobian = 6 * kPi * s * s * 2 * (1 - lowest) * v;
        return jacobian * f(Point{r * std::cos(phi), r * std::sin(phi), z});
    };
    return integrate_square(over_square, tolerance);
}

inline Point direction_at(long double inclination, long double azimuth) {
    const long double sine = std::sin(inclination);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), std::cos(inclination)};
}

} // namespace nusselt_test
