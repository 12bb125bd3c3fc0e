#pragma once
/// Lights on which every technique must do well: moderate in size and distance, one for each case that the
/// methods distinguish.

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

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

/// Coordinates are such that vertices are coplanar in every precision.
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

template <class Kind>
auto cases() {
    if constexpr (kIsPolygon<Kind>) {
        return polygon_cases();
    } else {
        return line_cases();
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
inline constexpr T kLargestBelowOne = 1 - std::numeric_limits<T>::epsilon() / 2;

template <class T>
T first(const nusselt::Vec2<T>& u) {
    return u.x;
}
inline float first(float u) { return u; }
inline double first(double u) { return u; }
inline long double first(long double u) { return u; }

/// Random numbers as a technique takes them, built from one or two coordinates.
template <class Kind, class T>
typename Kind::template Random<T> random_of(T x, [[maybe_unused]] T y) {
    if constexpr (kIsPolygon<Kind>) {
        return {x, y};
    } else {
        return x;
    }
}

/// The midpoints of a regular grid: count^2 points for polygons, count for lines.
template <class Kind, class T>
std::vector<typename Kind::template Random<T>> midpoints(int count) {
    std::vector<typename Kind::template Random<T>> points;
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < (kIsPolygon<Kind> ? count : 1); ++j) {
            points.push_back(random_of<Kind>((static_cast<T>(i) + T(0.5)) / static_cast<T>(count),
                                             (static_cast<T>(j) + T(0.5)) / static_cast<T>(count)));
        }
    }
    return points;
}

} // namespace nusselt_test
