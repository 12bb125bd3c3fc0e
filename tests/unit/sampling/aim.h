#pragma once
/// Checks in long double whether samples hit their light, and whether a light without samples is truly invisible.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "contract.h"
#include "geometry/reference.h"
#include "proof/hostile/round_reference.h"

namespace nusselt_test {

/// The light with the same vertices, but with edges and normal computed in long double.
template <class T, int N>
nusselt::ConvexPolygon<long double, N> widened(const nusselt::ConvexPolygon<T, N>& light) {
    Point vertices[N];
    for (int j = 0; j < N; ++j) vertices[j] = nusselt::broadcast<long double>(light.vertex[j]);
    return nusselt::make_polygon<N>(vertices, N);
}
template <class T>
nusselt::LineSegment<long double> widened(const nusselt::LineSegment<T>& light) {
    return {nusselt::broadcast<long double>(light.p0), nusselt::broadcast<long double>(light.s),
            light.length};
}

template <class T>
nusselt::LtcCoefficients<long double> widened(const nusselt::LtcCoefficients<T>& lobe) {
    return {lobe.m00, lobe.m02, lobe.m11, lobe.m20, lobe.m22, lobe.albedo};
}
template <class T, int N>
PolygonOnLobe<long double, N> widened(const PolygonOnLobe<T, N>& light) {
    const nusselt::ConvexPolygon<T, N>& polygon = light;
    return {widened(polygon), widened(light.lobe)};
}
template <class T>
LineOnLobe<long double> widened(const LineOnLobe<T>& light) {
    const nusselt::LineSegment<T>& line = light;
    return {widened(line), widened(light.lobe)};
}
template <class T>
nusselt::Cylinder<long double> widened(const nusselt::Cylinder<T>& light) {
    return {widened(light.axis), light.radius};
}
template <class T>
CylinderOnLobe<long double> widened(const CylinderOnLobe<T>& light) {
    const nusselt::Cylinder<T>& cylinder = light;
    return {widened(cylinder), widened(light.lobe)};
}

template <class T>
nusselt::Sphere<long double> widened(const nusselt::Sphere<T>& light) {
    return exact_light(light);
}
template <class T>
nusselt::Disk<long double> widened(const nusselt::Disk<T>& light) {
    return exact_light(light);
}
template <class T>
nusselt::Ellipse<long double> widened(const nusselt::Ellipse<T>& light) {
    return exact_light(light);
}
template <class T>
nusselt::Ellipsoid<long double> widened(const nusselt::Ellipsoid<T>& light) {
    return exact_light(light);
}
template <class T, template <class> class Shape>
RoundOnLobe<long double, Shape> widened(const RoundOnLobe<T, Shape>& light) {
    return {widened(static_cast<const Shape<T>&>(light)), widened(light.lobe)};
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

/// Angle by which a direction misses a light [rad], at most 0 inside. It refers to the closest triangle of the fan,
/// because rounded vertices may dent a polygon so that it is not exactly convex.
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
    return std::max(
        {std::fabs(dot(n, wi)), -dot(cross(n, normalize(begin)), wi), -dot(cross(normalize(end), n), wi)});
}

/// For cylinders, the angle subtended by the margin that must be added on all sides for a hit, up to a factor of 2.
template <class T>
long double miss(const nusselt::Cylinder<T>& light, const Point& wi) {
    const auto wide = widened(light);
    long double added = std::numeric_limits<long double>::epsilon() * (wide.axis.length + wide.radius);
    for (int i = 0; i < 64; ++i, added *= 2) {
        const nusselt::LineSegment<long double> axis = {wide.axis.p0 - added * wide.axis.s, wide.axis.s,
                                                        wide.axis.length + 2 * added};
        const auto hit = intersect(nusselt::Cylinder<long double>{axis, wide.radius + added}, wi);
        if (hit.hits) return added / hit.distance;
    }
    return 1;
}

template <class T, template <class> class Shape>
long double round_light_miss(const Shape<T>& light, const Point& wi) {
    return round_miss(widened(light), wi);
}
template <class T>
long double miss(const nusselt::Sphere<T>& light, const Point& wi) {
    return round_light_miss(light, wi);
}
template <class T>
long double miss(const nusselt::Disk<T>& light, const Point& wi) {
    return round_light_miss(light, wi);
}
template <class T>
long double miss(const nusselt::Ellipse<T>& light, const Point& wi) {
    return round_light_miss(light, wi);
}
template <class T>
long double miss(const nusselt::Ellipsoid<T>& light, const Point& wi) {
    return round_light_miss(light, wi);
}

/// Distance of the origin from the infinite line of a light.
inline long double carrier_distance(const nusselt::LineSegment<long double>& wide) {
    return length(cross(wide.p0, wide.s));
}

/// The smallest length, relative to the extent of a light, to which rounding of the vertices matters: the distance of
/// its plane or line and, for polygons, their width. Its reciprocal magnifies rounding errors.
template <int N>
long double sturdiness(const nusselt::ConvexPolygon<long double, N>& wide, long double extent) {
    const long double width = length(doubled_area_normal(wide)) / (extent * extent);
    return std::min({std::fabs(plane_distance(wide)) / extent, width, 1.0L});
}
inline long double sturdiness(const nusselt::LineSegment<long double>& wide, long double extent) {
    return std::min(carrier_distance(wide) / extent, 1.0L);
}
/// For cylinders, the distances of the lateral surface, continued to infinity, and of the closed surface, and the
/// length and the radius. In front of a cap and next to the continued surface, half of the half-planes around the
/// point see next to nothing.
inline long double sturdiness(const nusselt::Cylinder<long double>& wide, long double extent) {
    const long double begin = dot(wide.axis.p0, wide.axis.s);
    const long double outside = carrier_distance(wide.axis) - wide.radius;
    const long double gap = std::max({begin, -begin - wide.axis.length, outside});
    return std::min(
        {std::fabs(outside) / extent, gap / extent, wide.axis.length / extent, wide.radius / extent, 1.0L});
}

/// For round lights, the distances of the plane or the surface and the width.
inline long double sturdiness(const nusselt::Sphere<long double>& wide, long double extent) {
    return std::min({std::fabs(length(wide.center) - wide.radius) / extent, wide.radius / extent, 1.0L});
}
inline long double sturdiness(const nusselt::Disk<long double>& wide, long double extent) {
    return std::min({std::fabs(dot(wide.normal, wide.center)) / extent, wide.radius / extent, 1.0L});
}
inline long double sturdiness(const nusselt::Ellipse<long double>& wide, long double extent) {
    const auto area = cross(wide.u, wide.v);
    const long double longest = std::max(length(wide.u), length(wide.v));
    return std::min(
        {std::fabs(dot(normalize(area), wide.center)) / extent, length(area) / longest / extent, 1.0L});
}
inline long double sturdiness(const nusselt::Ellipsoid<long double>& wide, long double extent) {
    const auto space = space_of(wide);
    const auto at = (1 / space.unit) * wide.center;
    const long double away = std::hypot(dot(space.row[0], at), dot(space.row[1], at), dot(space.row[2], at));
    const long double width = space.thickness * space.unit;
    return std::min({std::fabs(away - 1) * width / extent, width / extent, 1.0L});
}

template <template <class> class Shape>
long double solid_angle_of(const Shape<long double>& wide) {
    return nusselt::ConeSolidAngle<long double, Shape>(wide).measure();
}

/// How large a light appears to a technique, without a unit: its measure, multiplied by the distance for lines.
template <class Kind, class WideLight>
long double apparent_size(const WideLight& wide) {
    if constexpr (kIsRound<Kind> && Kind::kMeasure == Measure::area) {
        return solid_angle_of(wide);
    } else if constexpr (kIsCylinder<Kind> || kIsRound<Kind>) {
        return typename Kind::template Technique<long double>(wide).measure();
    } else if constexpr (!kIsPolygon<Kind>) {
        if constexpr (Kind::kMeasure == Measure::area) return apparent_size<LineSolidAngleKind>(wide);
        return carrier_distance(wide) * typename Kind::template Technique<long double>(wide).measure();
    } else if constexpr (Kind::kMeasure == Measure::area) {
        return apparent_size<PolygonSolidAngleKindOf<Kind::kVertices>>(wide);
    } else {
        return typename Kind::template Technique<long double>(wide).measure();
    }
}

/// Whether the image of a line in cosine space passes the origin clearly: at more than twice the distance below which
/// techniques take it for a line through the origin. True for lights without a lobe.
template <class T, class WideLight>
bool image_is_apart(const WideLight&) {
    return true;
}
template <class T>
bool image_is_apart(const LineOnLobe<long double>& wide) {
    const auto image = nusselt::to_cosine_space<long double>(wide, nusselt::Ltc<long double>(wide.lobe));
    return carrier_distance(image) >
           2.0L * nusselt::kSmallestDistance<T> * std::sqrt(nusselt::squared_reach(image));
}

/// Whether a random number is away from the ends of its range. There, the light may meet the horizon: the density is
/// 0, and directions are as uncertain as for a light seen edge-on.
template <class T>
bool is_inner(T u) {
    return u > T(0.01) && u < T(0.99);
}
template <class T>
bool is_inner(const nusselt::Vec2<T>& u) {
    return is_inner(u.x) && is_inner(u.y);
}

/// Describes what is wrong with a sample of a light that is visible in every precision; empty if nothing is wrong or the
/// light is not so clearly visible.
template <class Kind, class T, class Light, class Random>
std::string aim_violation(const Light& light, const Random& u, const nusselt::LightSample<T>& sample) {
    constexpr long double kEpsilon = std::numeric_limits<T>::epsilon();
    // Fourth powers of lengths must fit into float. The lengths that follow are relative to the extent.
    const long double extent = Bounds(light).extent;
    if (!(extent > 1e-9L && extent < 1e9L)) return "";
    const auto wide = widened(light);
    const long double sturdy = sturdiness(wide, extent);
    // The effect of rounding is no longer proportional to it for lights that are thinner or closer to edge-on.
    if (!(sturdy > 1e-3L) || !(apparent_size<Kind>(wide) > 1e-3L)) return "";
    if (!is_inner(u)) return "";
    // A light whose heights are denormal, possibly after scaling its coordinates to order one, lies in the horizon if
    // denormals are flushed.
    const long double smallest = 2 * std::max(extent, 1.0L) * std::numeric_limits<T>::min();
    if (Kind::kHorizon == Horizon::clipped && !(Bounds(light).high.z >= smallest)) return "";
    // Area sampling of a closed surface gives no sample where the surface faces away.
    constexpr bool kFacesAway = kIsCylinder<Kind> && Kind::kMeasure == Measure::area;
    if (!(sample.pdf > 0))
        return kFacesAway || !image_is_apart<T>(wide) ? "" : "no sample of a visible light";

    // Rounding of the vertices tilts the plane of the light by an angle of this order. Among 6e4 lights, the largest
    // errors are 12 times that angle for directions and 8 times the rounding error for hit points that come from
    // weights.
    const long double tilt = std::max(kEpsilon, static_cast<long double>(kAngleError<Kind>)) / sturdy;
    constexpr long double kFactor = 32;
    const Point wi = nusselt::broadcast<long double>(sample.wi);
    const Point p = nusselt::broadcast<long double>(sample.p);
    if (Kind::kMeasure != Measure::area && !(miss(light, wi) <= kFactor * tilt)) return "wi misses the light";
    // Where a ray meets the plane at an angle of the order of `sturdy`, the error of the point exceeds that of the
    // direction.
    constexpr bool kMeetsPlane =
        kIsPolygon<Kind> && (Kind::kMeasure == Measure::projected_solid_angle || kHasLobe<Kind>);
    long double offset = kFactor * (kMeetsPlane ? tilt / sturdy : kEpsilon) * extent;
    // Vertices that are not in one plane leave open in which plane the point is.
    if constexpr (kMeetsPlane) {
        const auto warp = nusselt::warp_of(light, nusselt::plane_distance(light));
        offset += kFactor * static_cast<long double>(warp) / (sturdy * sturdy);
    }
    if (!(length(cross(wi, p)) <= offset)) return "p is not in the direction wi";
    if (dot(wi, p) < -offset) return "p is behind the origin";
    return "";
}

} // namespace nusselt_test
