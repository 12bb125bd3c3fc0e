#pragma once
/// Convex planar polygons with a compile-time bound on the number of vertices.

#include <nusselt/core/frame.h>
#include <nusselt/geometry/precise_products.h>

NUSSELT_NAMESPACE_BEGIN

/// A convex, planar polygon of 3 to N vertices in either winding.
///
/// Edges and the normal are properties of the light, not of where it is seen from: they are stored and
/// rotated, never recomputed from vertices after a shading point was subtracted. At a distance of 40 m the
/// spacing of floats is 4 micrometres, 0.4 % of a light of 1 mm.
///
/// Unused slots repeat the last vertex, with edges of length zero between the copies; edge[N - 1] always
/// closes the polygon. So loops run over all N slots with static indices and no masks, and a vertex count is
/// not needed: techniques treat edges of length zero as absent, also those between repeated vertices of the
/// input.
template <class Real, int N>
struct ConvexPolygon {
    static_assert(N >= 3, "a polygon has at least three vertices");
    Vec3<Real> vertex[N]; ///< positions [m]
    Vec3<Real> edge[N];   ///< edge[j] leads from vertex j to its successor in cyclic order [m]
    Vec3<Real> normal;    ///< unit normal, right-handed with the winding; zero if the polygon has no area
};

/// Twice the area times the right-handed unit normal; zero if the area cannot be distinguished from rounding.
template <class Real, int N>
NUSSELT_HD inline Vec3<Real> doubled_area_normal(const ConvexPolygon<Real, N>& polygon) noexcept {
    Vec3<Real> offset = polygon.edge[0];
    Vec3<Real> sum{Real(0), Real(0), Real(0)};
    Vec3<Real> lost = sum; // from the offset by rounding: it would give edges on one line an area
    Real bound = Real(0);
    for (int j = 1; j < N - 1; ++j) {
        const Vec3<Real>& edge = polygon.edge[j];
        sum = sum + (cross(offset, edge) + cross(lost, edge));
        bound = bound +
                (abs(offset.x) + abs(offset.y) + abs(offset.z)) * (abs(edge.x) + abs(edge.y) + abs(edge.z));
        const Vec3<Real> next = offset + edge;
        const Vec3<Real> added = next - offset;
        lost = lost + ((offset - (next - added)) + (edge - added));
        offset = next;
    }
    constexpr scalar_t<Real> kRounding = std::numeric_limits<scalar_t<Real>>::epsilon();
    const auto present =
        max(max(abs(sum.x), abs(sum.y)), abs(sum.z)) > Real(8 * kRounding * kRounding) * bound;
    return select(present, sum, Vec3<Real>{Real(0), Real(0), Real(0)});
}

namespace detail {

/// The dot product, 0 if it cannot be distinguished from rounding.
template <class Real>
NUSSELT_INLINE Real dot_or_zero(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    const Vec3<Real> product{a.x * b.x, a.y * b.y, a.z * b.z};
    const Real sum = product.x + product.y + product.z;
    const Real rounding = Real(4 * std::numeric_limits<scalar_t<Real>>::epsilon()) *
                          (abs(product.x) + abs(product.y) + abs(product.z));
    return select(abs(sum) > rounding, sum, Real(0));
}

/// Least sine of the angle between the plane of a polygon and the direction to a vertex for which rounding can be
/// ignored: it magnifies rounding errors by the reciprocal. With fma, half of that sine suffices.
template <class Scalar>
inline constexpr Scalar kConclusive = Scalar(NUSSELT_HAS_FMA ? 1.0 / 256 : 1.0 / 128);

/// Largest coordinate by magnitude.
template <class Real>
NUSSELT_INLINE Real extent_of(const Vec3<Real>& v) noexcept {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// The vertex whose product with the normal has the smallest rounding error, none if it is the origin.
template <class Real, int N>
NUSSELT_INLINE Vec3<Real> nearest_vertex(const ConvexPolygon<Real, N>& polygon) noexcept {
    Vec3<Real> nearest = polygon.vertex[0];
    NUSSELT_UNROLL
    for (int j = 1; j < N; ++j)
        nearest = select(extent_of(polygon.vertex[j]) < extent_of(nearest), polygon.vertex[j], nearest);
    return nearest;
}

/// The distance of the plane that the rounded normal describes; 0 if it cannot be distinguished from rounding.
template <class Real, int N>
NUSSELT_INLINE Real rounded_plane_distance(const ConvexPolygon<Real, N>& polygon,
                                           const Vec3<Real>& nearest) noexcept {
    return dot_or_zero(polygon.normal, nearest);
}

/// Calls visit(j, product) for each triangle j of the fan around vertex 0: with the triple product of v and two of its
/// sides, in the order of the winding, whose error is that of a single rounding.
///
/// Edges of polygons from make_polygon() are rounded differences of vertices: the vertices tell what was lost. Where
/// the edges were there first, as in shading space, the vertices are rounded sums of edges: they differ from the edges
/// by more than rounding of the edges explains, except where both errors are equally small.
template <class Real, int N, class Visit>
NUSSELT_INLINE void for_each_precise_triangle(const ConvexPolygon<Real, N>& polygon, const Vec3<Real>& v,
                                              const Visit& visit) noexcept {
    const Vec3<Real> zero{Real(0), Real(0), Real(0)};
    Vec3<Real> offset = polygon.edge[0]; // from vertex 0 to vertex j + 1
    Vec3<Real> lost = zero;
    Vec3<Real> rounding = rounding_of(offset);
    for (int j = 0; j < N - 2; ++j) {
        const Vec3<Real>& a = polygon.vertex[j + 1];
        const Vec3<Real>& edge = polygon.edge[j + 1];
        const Vec3<Real> edge_rounding = rounding_of(edge);
        const Vec3<Real> offset_excess = excess_of_side(polygon.vertex[0], a, offset, lost, rounding);
        const Vec3<Real> edge_excess = excess_of_side(a, polygon.vertex[j + 2], edge, zero, edge_rounding);
        visit(j, precise_triple_product(v, offset, edge) +
                     (triple_product(v, offset_excess, edge) + triple_product(v, offset, edge_excess)));
        const WithError<Real> x = exact_sum(offset.x, edge.x);
        const WithError<Real> y = exact_sum(offset.y, edge.y);
        const WithError<Real> z = exact_sum(offset.z, edge.z);
        offset = {x.value, y.value, z.value};
        lost = lost + Vec3<Real>{x.error, y.error, z.error};
        rounding = rounding + edge_rounding;
    }
}

/// The distance of the plane through a vertex, from the vertices and edges instead of the rounded normal.
/// \param rounded distance, for lights whose areas leave the range of numbers.
template <class Real, int N>
NUSSELT_HD inline Real precise_plane_distance(const ConvexPolygon<Real, N>& polygon, const Vec3<Real>& vertex,
                                              const Real& rounded) noexcept {
    Real product = Real(0);
    for_each_precise_triangle(polygon, vertex,
                              [&](int, const Real& of_triangle) { product = product + of_triangle; });
    const Vec3<Real> normal = doubled_area_normal(polygon);
    const Real squared = dot(normal, normal);
    constexpr scalar_t<Real> kLeast = kTiny<scalar_t<Real>>;
    const auto in_range = (squared > Real(kLeast)) & (squared < Real(1 / kLeast));
    return select(in_range, product / sqrt(select(in_range, squared, Real(1))), rounded);
}

} // namespace detail

/// Signed distance of the origin from the plane of the polygon [m], positive if the normal points away from it; 0 if it
/// cannot be distinguished from rounding.
template <class Real, int N>
NUSSELT_HD inline Real plane_distance(const ConvexPolygon<Real, N>& polygon) noexcept {
    const Vec3<Real> nearest = detail::nearest_vertex(polygon);
    const Real rounded = detail::rounded_plane_distance(polygon, nearest);
    const auto close =
        (abs(rounded) < Real(detail::kConclusive<scalar_t<Real>>) * detail::extent_of(nearest)) &
        (rounded != Real(0));
    if (!any(close)) return rounded;
    return select(close, detail::precise_plane_distance(polygon, nearest, rounded), rounded);
}

/// The largest distance of a vertex from the plane of a polygon [m].
/// \param distance of that plane from the origin.
template <class Real, int N>
NUSSELT_HD inline Real warp_of(const ConvexPolygon<Real, N>& polygon, const Real& distance) noexcept {
    Real largest = Real(0);
    for (const Vec3<Real>& v : polygon.vertex) largest = max(largest, abs(dot(polygon.normal, v) - distance));
    return largest;
}

/// The polygon with the given vertices [m].
/// \param vertices convex and coplanar, in either winding; repeated and collinear vertices are fine. Nothing checks
///                 this: techniques sample a concave outline in a way that means nothing. split_convex() splits it.
/// \param count    how many of them there are, 3 to N. Scalars only: a light has one vertex count.
template <int N, class Real>
NUSSELT_HD inline ConvexPolygon<Real, N> make_polygon(const Vec3<Real>* vertices, int count) noexcept {
    ConvexPolygon<Real, N> polygon;
    polygon.vertex[0] = vertices[0];
    for (int j = 1; j < N; ++j) polygon.vertex[j] = j < count ? vertices[j] : polygon.vertex[j - 1];
    for (int j = 0; j < N; ++j) polygon.edge[j] = polygon.vertex[j + 1 < N ? j + 1 : 0] - polygon.vertex[j];
    polygon.normal = normalize(doubled_area_normal(polygon));
    return polygon;
}

/// The same polygon in all lanes.
template <class Real, class Single, int N>
NUSSELT_HD inline ConvexPolygon<Real, N> broadcast(const ConvexPolygon<Single, N>& polygon) noexcept {
    ConvexPolygon<Real, N> result;
    for (int j = 0; j < N; ++j) {
        result.vertex[j] = broadcast<Real>(polygon.vertex[j]);
        result.edge[j] = broadcast<Real>(polygon.edge[j]);
    }
    result.normal = broadcast<Real>(polygon.normal);
    return result;
}

/// The polygon seen from a shading point: the point becomes the origin, the normal of the frame +z.
/// \tparam Real may be a pack while the polygon is scalar: one light, a shading point per lane.
template <class Real, class LightReal, int N>
NUSSELT_HD inline ConvexPolygon<Real, N> to_shading_space(const ConvexPolygon<LightReal, N>& world,
                                                          const Vec3<Real>& point,
                                                          const Frame<Real>& frame) noexcept {
    ConvexPolygon<Real, N> local;
    local.vertex[0] = frame.to_local(broadcast<Real>(world.vertex[0]) - point);
    for (int j = 0; j < N; ++j) {
        local.edge[j] = frame.to_local(broadcast<Real>(world.edge[j]));
        if (j + 1 < N) local.vertex[j + 1] = local.vertex[j] + local.edge[j];
    }
    local.normal = frame.to_local(broadcast<Real>(world.normal));
    return local;
}

NUSSELT_NAMESPACE_END
