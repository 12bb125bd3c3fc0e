#pragma once
/// Whether samples hit their light, and whether a light that gives none is to blame, in long double.

#include <algorithm>
#include <cmath>

#include "geometry/reference.h"
#include "techniques.h"

namespace nusselt_test {

template <class T, int N>
nusselt::ConvexPolygon<long double, N> widened(const nusselt::ConvexPolygon<T, N>& light) {
    nusselt::ConvexPolygon<long double, N> wide;
    for (int j = 0; j < N; ++j) {
        wide.vertex[j] = nusselt::broadcast<long double>(light.vertex[j]);
        wide.edge[j] = nusselt::broadcast<long double>(light.edge[j]);
    }
    wide.normal = nusselt::broadcast<long double>(light.normal);
    return wide;
}
template <class T>
nusselt::LineSegment<long double> widened(const nusselt::LineSegment<T>& light) {
    return {nusselt::broadcast<long double>(light.p0), nusselt::broadcast<long double>(light.s), light.length};
}

/// How far a direction passes beyond the farthest of the planes through the origin and the sides of a triangle [rad];
/// 1 for a triangle without solid angle.
inline long double miss(const Point& a, const Point& b, const Point& c, const Point& wi) {
    const long double orientation = dot(cross(a, b), c);
    long double farthest = -1;
    for (const Point& n : {cross(a, b), cross(b, c), cross(c, a)}) {
        const long double norm = length(n);
        if (norm == 0 || orientation == 0) return 1;
        farthest = std::max(farthest, -std::copysign(1 / norm, orientation) * dot(n, wi));
    }
    return farthest;
}

/// Angle by which a direction misses a light [rad], at most 0 inside. The triangle of the fan that it is closest to
/// counts: rounding of vertices may dent a polygon, so that it is not exactly convex.
template <class T, int N>
long double miss(const nusselt::ConvexPolygon<T, N>& light, const Point& wi) {
    const auto wide = widened(light);
    long double closest = 1;
    for (int j = 1; j + 1 < N; ++j) {
        closest = std::min(closest, miss(wide.vertex[0], wide.vertex[j], wide.vertex[j + 1], wi));
    }
    return closest;
}
template <class T>
long double miss(const nusselt::LineSegment<T>& light, const Point& wi) {
    const Point begin = widened_begin(light);
    const Point end = widened_end(light);
    const Point n = normalize(cross(begin, end));
    return std::max({std::fabs(dot(n, wi)), -dot(cross(n, normalize(begin)), wi), -dot(cross(normalize(end), n), wi)});
}

} // namespace nusselt_test
