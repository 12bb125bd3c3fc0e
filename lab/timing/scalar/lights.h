#pragma once
/// Random lights to time samplers with.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/line_segment.h>

namespace nusselt::lab {

/// A class of lights in shading space, at a distance of about one.
struct LightClass {
    const char* name;
    double lowest, highest; ///< height of the centre [m]
    double radius;          ///< half the extent of the light [m]
    bool above_zenith;      ///< centred at the zenith, polygons horizontal
};

inline constexpr LightClass kDecentral = {"decentral", 0.5, 0.7, 0.3, false};
inline constexpr LightClass kCentral = {"central", 1.0, 1.0, 0.5, true};
inline constexpr LightClass kCrossing = {"crossing the horizon", -0.1, 0.1, 0.4, false};
inline constexpr LightClass kLineAbove = {"above the horizon", 0.5, 0.7, 0.4, false};

inline constexpr int kMostCorners = 8;

/// The corners of an irregular convex polygon of random orientation [m], or the ends of a line. Angles between
/// neighbouring corners differ from those of a regular polygon by up to a half.
/// \param count of corners, at most kMostCorners; 2 for a line. Spare ones repeat the last.
inline std::array<Vec3<double>, kMostCorners> random_light(const LightClass& c, int count,
                                                           std::mt19937& generator) {
    constexpr double kTurn = 2 * kPi<double>;
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::normal_distribution<double> normal;
    const double height = c.lowest + (c.highest - c.lowest) * uniform(generator);
    const double azimuth = kTurn * uniform(generator);
    const double side = c.above_zenith ? 0.0 : std::sqrt(1 - height * height);
    const Vec3<double> centre{side * std::cos(azimuth), side * std::sin(azimuth), height};
    const auto direction = [&](double z) {
        return normalize(Vec3<double>{normal(generator), normal(generator), z * normal(generator)});
    };
    const Vec3<double> a = direction(c.above_zenith ? 0.0 : 1.0);
    const Vec3<double> other = c.above_zenith ? Vec3<double>{-a.y, a.x, 0.0} : direction(1.0);
    const Vec3<double> b = normalize(other - dot(a, other) * a);
    std::array<Vec3<double>, kMostCorners> corners;
    for (std::size_t j = 0; j < corners.size(); ++j) {
        const int i = static_cast<int>(j);
        const double shift = count == 2 ? 0.0 : 0.5 * (uniform(generator) - 0.5);
        const double angle = kTurn * (i + shift) / count;
        const Vec3<double> corner = centre + c.radius * (std::cos(angle) * a + std::sin(angle) * b);
        corners[j] = i < count ? corner : corners[j - 1];
    }
    return corners;
}

/// A unit vector, uniform on the sphere.
inline Vec3<double> random_normal(std::mt19937& generator) {
    std::normal_distribution<double> normal;
    return normalize(Vec3<double>{normal(generator), normal(generator), normal(generator)});
}

} // namespace nusselt::lab
