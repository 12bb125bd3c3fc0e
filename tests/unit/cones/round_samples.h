#pragma once
/// What tests ask of samples of round lights: where they are on the light, and how the map stretches the square.

#include <algorithm>
#include <cmath>

#include "cones/round_cases.h"

namespace nusselt_test {

/// The middle of cell i of a grid.
template <class T>
nusselt::Vec2<T> grid(int i, int side) {
    const T size = static_cast<T>(side);
    return {(static_cast<T>(i % side) + T(0.5)) / size, (static_cast<T>(i / side) + T(0.5)) / size};
}

/// Area of directions per area of random numbers, by differences over 2e-5 in double.
template <class Technique>
double jacobian_at(const Technique& technique, const nusselt::Vec2<double>& u) {
    constexpr double kStep = 1e-5;
    const auto by_x = technique.sample({u.x + kStep, u.y}).wi - technique.sample({u.x - kStep, u.y}).wi;
    const auto by_y = technique.sample({u.x, u.y + kStep}).wi - technique.sample({u.x, u.y - kStep}).wi;
    return length(cross(by_x, by_y)) / (4 * kStep * kStep);
}

/// Distance of a point from a light relative to the size of the light.
inline double distance_from(const RoundLight& light, const nusselt::Vec3<double>& p) {
    double coordinate[3];
    for (int i = 0; i < 3; ++i)
        coordinate[i] = dot(p - light.center, light.axis[i]) / dot(light.axis[i], light.axis[i]);
    const auto [x, y, z] = coordinate;
    if (light.shape == Shape::sphere || light.shape == Shape::ellipsoid)
        return std::fabs(std::sqrt(x * x + y * y + z * z) - 1);
    return std::max(std::hypot(x, y) - 1, 0.0) + std::fabs(z) * length(light.axis[2]) / length(light.axis[0]);
}

} // namespace nusselt_test
