#pragma once
/// Integrals of the specular Frostbite BRDF by textbook formulas of their own: no code is shared with the fit.

#include "fit/slice.h"

#include <algorithm>
#include <cmath>

namespace nusselt::fit::test {

struct Direction {
    double x, y, z;
};

/// BRDF times cosine [1/sr].
inline double specular(const Slice& s, const Direction& wi) {
    const double pi = std::acos(-1.0);
    const double cos_o = std::cos(s.inclination), sin_o = std::sin(s.inclination);
    if (wi.z <= 0 || cos_o <= 0) return 0;
    const double x = wi.x + sin_o, z = wi.z + cos_o;
    const double length = std::sqrt(x * x + wi.y * wi.y + z * z);
    const double n_h = z / length, v_h = std::min(length / 2, 1.0);
    const double a2 = std::pow(std::max(s.roughness * s.roughness, 1e-4), 2);
    const double d = a2 / (pi * std::pow(n_h * n_h * (a2 - 1) + 1, 2));
    const auto lambda = [a2](double c) { return (std::sqrt(1 + a2 * (1 - c * c) / (c * c)) - 1) / 2; };
    const double g = 1 / (1 + lambda(cos_o) + lambda(wi.z));
    const double f = s.f0 + (1 - s.f0) * std::pow(1 - v_h, 5);
    return d * g * f / (4 * cos_o);
}

/// Integral of specular() by sampling the distribution of normals (not the visible ones) on a grid.
inline double albedo(const Slice& s, int grid = 512) {
    const double pi = std::acos(-1.0);
    const double cos_o = std::cos(s.inclination), sin_o = std::sin(s.inclination);
    const double alpha = std::max(s.roughness * s.roughness, 1e-4);
    double sum = 0;
    for (int j = 0; j < grid; ++j)
        for (int i = 0; i < grid; ++i) {
            // The square crowds nodes where normals are steep: such weigh most at grazing angles.
            const double v = (j + 0.5) / grid;
            const double u = 1 - v * v;
            const double tangent2 = alpha * alpha * u / (1 - u);
            const double phi = pi * (i + 0.5) / grid;
            const double n_h = 1 / std::sqrt(1 + tangent2), sin_h = std::sqrt(tangent2) * n_h;
            const Direction h{sin_h * std::cos(phi), sin_h * std::sin(phi), n_h};
            const double v_h = h.x * sin_o + h.z * cos_o;
            if (v_h <= 0) continue;
            const Direction wi{2 * v_h * h.x - sin_o, 2 * v_h * h.y, 2 * v_h * h.z - cos_o};
            const double a2 = alpha * alpha;
            const double density = a2 / (pi * std::pow(a2 + (1 - a2) * sin_h * sin_h, 2)) * n_h;
            const double weight = specular(s, wi) / density * 4 * v_h;
            sum += weight * 2 * v;
        }
    return sum / grid / grid;
}

/// f(direction) over the sphere, symmetric in y, by midpoints.
template <class Function>
double over_sphere(const Function& f, int grid = 1000) {
    const double pi = std::acos(-1.0);
    double sum = 0;
    for (int j = 0; j < grid; ++j) {
        const double theta = pi * (j + 0.5) / grid;
        double ring = 0;
        for (int i = 0; i < grid; ++i) {
            const double phi = pi * (i + 0.5) / grid;
            ring += f(
                Direction{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
        }
        sum += ring * std::sin(theta);
    }
    return sum * 2 * pi * pi / grid / grid;
}

} // namespace nusselt::fit::test
