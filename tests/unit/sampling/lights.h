#pragma once
/// Lights of moderate size and distance, on which every technique must be accurate. Each case that the methods
/// distinguish has a light.

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "proof/tube_lights.h"
#include "techniques.h"

namespace nusselt_test {

struct PolygonCase {
    std::string name;
    std::vector<nusselt::Vec3<double>> vertices;
};

struct LineCase {
    std::string name;
    nusselt::Vec3<double> begin, end;
};

using CylinderCase = nusselt::proof::TubeLight;

/// An octagon that two vectors span about a center. With short binary coordinates, it is exact in every precision.
inline std::vector<nusselt::Vec3<double>>
octagon(const nusselt::Vec3<double>& center, const nusselt::Vec3<double>& a, const nusselt::Vec3<double>& b) {
    std::vector<nusselt::Vec3<double>> vertices;
    constexpr double kCoordinates[] = {1, 0.375, -0.375, -1, -1, -0.375, 0.375, 1};
    for (int j = 0; j < 8; ++j)
        vertices.push_back(center + kCoordinates[(j + 1) % 8] * a + kCoordinates[(j + 7) % 8] * b);
    return vertices;
}

/// The coordinates are chosen so that the vertices are coplanar in every precision.
inline std::vector<PolygonCase> polygon_cases() {
    return {
        {"zenith inside", {{-1, -0.7, 1}, {1.2, -0.8, 1}, {1.1, 0.9, 1}, {-0.9, 1, 1}}},
        {"zenith inside, tilted", {{-1, -1, 0.5}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 0.5}}},
        {"zenith outside", {{0.5, 0.2, 1}, {1.5, 0.3, 1}, {1.4, 1.2, 1}, {0.4, 1, 1}}},
        {"other winding", {{0.4, 1, 1}, {1.4, 1.2, 1}, {1.5, 0.3, 1}, {0.5, 0.2, 1}}},
        {"triangle", {{0.3, -1, 0.5}, {1.5, -0.2, 0.7}, {0.6, 1, 1.2}}},
        {"wall on the floor", {{1, -1, 0}, {1, 1, 0}, {1, 1, 1.5}, {1, -1, 1.5}}},
        {"wall through the floor", {{1, -1, -0.5}, {1, 1, -0.5}, {1, 1, 1}, {1, -1, 1}}},
        {"one vertex below", {{0.5, -0.25, 1}, {1.5, 0.25, -0.25}, {1.5, 0.625, 0.3125}, {0.75, 0.25, 1.25}}},
        {"three vertices below", {{0.5, 0.5, 1}, {1.5, 1, -1}, {2, 0.5, -3}, {1, 0, -1}}},
        {"zenith inside, clipped", {{-1, -1, -0.5}, {-1, 1, -0.5}, {1.5, 1, 2}, {1.5, -1, 2}}},
        {"zenith on an edge", {{0, -1, 1}, {1, -1, 1}, {1, 1, 1}, {0, 1, 1}}},
        {"zenith on a vertex", {{0, 0, 1}, {1, 0.2, 1}, {0.8, 1.1, 1}}},
        {"octant", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
        {"small", {{1, 0.5, 2}, {1.02, 0.5, 2}, {1.02, 0.53, 2}, {1, 0.53, 2}}},
        {"large and close", {{-20, -30, 0.5}, {25, -30, 0.5}, {25, 20, 0.5}, {-20, 20, 0.5}}},
    };
}

/// Polygons that need more than four slots. Some leave slots unused.
inline std::vector<PolygonCase> many_vertex_cases() {
    return {
        {"pentagon around the zenith",
         {{-1, -0.5, 1}, {0.5, -1, 1}, {1.25, 0.25, 1}, {0.5, 1, 1}, {-0.75, 0.75, 1}}},
        {"pentagon, one vertex below",
         {{0.5, 0, 0.875}, {1, -0.75, 0.3125}, {2, -0.25, -0.3125}, {1.75, 0.5, 0.0625}, {1, 0.75, 0.6875}}},
        {"hexagon, zenith outside",
         {{0.5, 0.25, 1}, {1, 0, 1}, {1.5, 0.25, 1}, {1.5, 0.75, 1}, {1, 1, 1}, {0.5, 0.75, 1}}},
        {"hexagon, other winding",
         {{0.5, 0.75, 1}, {1, 1, 1}, {1.5, 0.75, 1}, {1.5, 0.25, 1}, {1, 0, 1}, {0.5, 0.25, 1}}},
        {"heptagonal wall through the floor",
         {{1, -0.5, -0.75},
          {1, 0.25, -1},
          {1, 0.75, -0.5},
          {1, 1, 0.25},
          {1, 0.5, 1},
          {1, -0.25, 1.25},
          {1, -0.75, 0.5}}},
        {"octagon around the zenith, clipped", octagon({0.25, 0.125, 0.5}, {1, 0, 1}, {0, 1, 0})},
        {"octagon, zenith outside, clipped", octagon({1.5, 0.5, 0.25}, {1, 0, 0.5}, {0, 1, 0.25})},
        {"octagon around the zenith", octagon({0.25, 0.125, 1}, {1, 0, 0.25}, {0, 1, -0.125})},
        {"small octagon", octagon({1, 0.5, 2}, {0.03125, 0, 0}, {0, 0.03125, 0.015625})},
        {"quadrilateral", {{-1, -0.75, 1}, {1.25, -0.75, 1}, {1, 1, 1}, {-1, 0.75, 1}}},
        {"triangle", {{0.25, -1, 0.5}, {1.5, -0.25, 0.75}, {0.5, 1, 1.25}}},
    };
}

inline std::vector<LineCase> line_cases() {
    return {
        {"symmetric", {-1, 0.5, 1}, {1, 0.5, 1}},
        {"oblique", {0.5, -0.4, 0.7}, {1.5, 0.8, 2}},
        {"end on the floor", {1, 0.3, 0}, {0.4, -0.5, 1}},
        {"through the floor", {1, 0.3, -0.5}, {0.4, -0.5, 1}},
        {"downwards through the floor", {0.4, -0.5, 1}, {1, 0.3, -0.5}},
        {"vertical", {0.5, 0.2, 0.1}, {0.5, 0.2, 2}},
        {"over the point", {-3, 0, 0.4}, {2, 0, 0.4}},
        {"short", {1, 0.5, 2}, {1.01, 0.52, 2.01}},
        {"long and close", {-50, 0.2, 0.5}, {70, 0.3, 0.6}},
    };
}

inline std::vector<CylinderCase> cylinder_cases() { return nusselt::proof::tube_lights(); }

/// Spheres, disks and ellipses are made from these as hostile::RoundKind does. None contains the origin.
struct RoundCase {
    std::string name;
    nusselt::Ellipsoid<double> ellipsoid;
};

inline std::vector<RoundCase> round_cases() {
    return {
        {"above", {{0.25, -0.5, 2}, {{0.75, 0.25, 0}, {-0.25, 0.5, 0.25}, {0.125, -0.125, 0.75}}}},
        {"around the zenith", {{0, 0, 1}, {{0.5, 0, 0}, {0, 0.75, 0}, {0, 0, 0.25}}}},
        {"through the floor",
         {{1.5, 0.5, 0.125}, {{0, 0.5, 0.25}, {-0.25, 0.25, 0.75}, {0.5, 0.25, -0.125}}}},
        {"touches the floor", {{1, 1, 0.5}, {{0, 0, 0.5}, {0.5, -0.5, 0}, {0.25, 0.25, 0}}}},
        {"short",
         {{1, 0.5, 2}, {{0.0078125, 0, 0.00390625}, {0, 0.0078125, 0}, {-0.00390625, 0, 0.0078125}}}},
        {"large and close", {{1, 0.5, 0.75}, {{1.25, 0, 0.0625}, {0, 5, 0}, {-0.015625, 0, 0.5}}}},
        {"elongated", {{0.5, 1, 1}, {{0.75, 0.25, 0.25}, {-0.0625, 0.125, 0.0625}, {0, -0.0625, 0.125}}}},
    };
}

struct LobeCase {
    std::string name;
    nusselt::LtcCoefficients<double> coefficients;
};

/// Lobes that are exact in every precision. All lights of the lists are at least partly above their horizons. One
/// lobe leans towards the eye, so that parts of some lights are above its horizon but below the surface.
inline std::vector<LobeCase> lobe_cases() {
    return {
        {"rough", {1, 0.25, 1.25, -0.1875, 0.875, 1}},
        {"glossy", nusselt::proof::kGlossyLobe},
    };
}

template <class LightCase>
struct OnLobe : LightCase {
    nusselt::LtcCoefficients<double> lobe;
};

/// Each light with each lobe.
template <class LightCase>
std::vector<OnLobe<LightCase>> with_lobes(const std::vector<LightCase>& lights) {
    std::vector<OnLobe<LightCase>> result;
    for (const LobeCase& lobe : lobe_cases()) {
        for (const LightCase& light : lights) {
            result.push_back({light, lobe.coefficients});
            result.back().name += ", " + lobe.name + " lobe";
        }
    }
    return result;
}

template <class Kind>
auto geometry_cases() {
    if constexpr (kIsCylinder<Kind>) {
        return cylinder_cases();
    } else if constexpr (kIsRound<Kind>) {
        return round_cases();
    } else if constexpr (!kIsPolygon<Kind>) {
        return line_cases();
    } else if constexpr (Kind::kVertices == 4) {
        return polygon_cases();
    } else {
        auto result = many_vertex_cases();
        std::erase_if(result, [](const PolygonCase& light) {
            return light.vertices.size() > std::size_t{Kind::kVertices};
        });
        return result;
    }
}

template <class Kind>
auto cases() {
    if constexpr (kHasLobe<Kind>) {
        return with_lobes(geometry_cases<Kind>());
    } else {
        return geometry_cases<Kind>();
    }
}

template <class T, int N = 4>
nusselt::ConvexPolygon<T, N> make_light(const PolygonCase& polygon) {
    std::array<nusselt::Vec3<T>, N> vertices = {};
    std::transform(polygon.vertices.begin(), polygon.vertices.end(), vertices.begin(),
                   [](const nusselt::Vec3<double>& v) { return nusselt::broadcast<T>(v); });
    return nusselt::make_polygon<N>(vertices.data(), static_cast<int>(polygon.vertices.size()));
}

template <class T>
nusselt::LineSegment<T> make_light(const LineCase& line) {
    return nusselt::make_line(nusselt::broadcast<T>(line.begin), nusselt::broadcast<T>(line.end));
}

template <class T>
nusselt::Cylinder<T> make_light(const CylinderCase& cylinder) {
    return {nusselt::make_line(nusselt::broadcast<T>(cylinder.begin), nusselt::broadcast<T>(cylinder.end)),
            static_cast<T>(cylinder.radius)};
}

template <class T>
nusselt::Ellipsoid<T> make_light(const RoundCase& light) {
    const auto v = [](const nusselt::Vec3<double>& a) { return nusselt::broadcast<T>(a); };
    const auto& [center, axis] = light.ellipsoid;
    return {v(center), {v(axis[0]), v(axis[1]), v(axis[2])}};
}

template <class To, class From>
nusselt::LtcCoefficients<To> rounded(const nusselt::LtcCoefficients<From>& lobe) {
    const auto entry = [](From x) { return static_cast<To>(x); };
    return {entry(lobe.m00), entry(lobe.m02), entry(lobe.m11),
            entry(lobe.m20), entry(lobe.m22), entry(lobe.albedo)};
}

/// The light of a case in the type that a technique takes.
template <class Kind, class T, class Case>
typename Kind::template Light<T> light_for(const Case& light) {
    if constexpr (kHasLobe<Kind> && kIsPolygon<Kind>) {
        return {make_light<T, Kind::kVertices>(light), rounded<T>(light.lobe)};
    } else if constexpr (kHasLobe<Kind>) {
        return {Kind::from(make_light<T>(light)), rounded<T>(light.lobe)};
    } else if constexpr (kIsPolygon<Kind>) {
        return Kind::from(make_light<T, Kind::kVertices>(light));
    } else {
        return Kind::from(make_light<T>(light));
    }
}

template <class T>
inline constexpr T kLargestBelowOne = 1 - std::numeric_limits<T>::epsilon() / 2;

template <class T>
T first(const nusselt::Vec2<T>& u) {
    return u.x;
}
inline float first(float u) { return u; }
inline double first(double u) { return u; }
inline long double first(long double u) { return u; }

/// Random numbers in the type that a technique takes, from one or two coordinates.
template <class Kind, class T>
typename Kind::template Random<T> random_of(T x, [[maybe_unused]] T y) {
    if constexpr (kTakesPairs<Kind>) {
        return {x, y};
    } else {
        return x;
    }
}

/// The midpoints of a regular grid: count^2 points for polygons and cylinders, count for lines.
template <class Kind, class T>
std::vector<typename Kind::template Random<T>> midpoints(int count) {
    std::vector<typename Kind::template Random<T>> points;
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < (kTakesPairs<Kind> ? count : 1); ++j) {
            points.push_back(random_of<Kind>((static_cast<T>(i) + T(0.5)) / static_cast<T>(count),
                                             (static_cast<T>(j) + T(0.5)) / static_cast<T>(count)));
        }
    }
    return points;
}

} // namespace nusselt_test
