#pragma once
/// Triple products of the triangles of a polygon, which decide how large it appears.

#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// A sum or product and what rounding took from it.
template <class Real>
struct WithError {
    Real value, error;
};

/// Exact, also if a is smaller than b (Knuth 1998, The Art of Computer Programming 2, Sec. 4.2.2).
template <class Real>
NUSSELT_INLINE WithError<Real> exact_sum(const Real& a, const Real& b) noexcept {
    const Real sum = a + b;
    const Real added = sum - a;
    return {sum, (a - (sum - added)) + (b - added)};
}
template <class Real>
NUSSELT_INLINE WithError<Real> exact_product(const Real& a, const Real& b) noexcept {
    const Real product = a * b;
    return {product, fma(a, b, -product)};
}

/// a * b - c * d with an error as if computed in twice the precision.
template <class Real>
NUSSELT_INLINE WithError<Real> precise_difference_of_products(const Real& a, const Real& b, const Real& c,
                                                              const Real& d) noexcept {
    const WithError<Real> ab = exact_product(a, b);
    const WithError<Real> cd = exact_product(c, d);
    const WithError<Real> sum = exact_sum(ab.value, -cd.value);
    return {sum.value, sum.error + (ab.error - cd.error)};
}

/// The triple product det(v, a, b), computed in twice the precision and rounded once.
template <class Real>
NUSSELT_INLINE Real precise_triple_product(const Vec3<Real>& v, const Vec3<Real>& a,
                                           const Vec3<Real>& b) noexcept {
    const WithError<Real> nx = precise_difference_of_products(a.y, b.z, a.z, b.y);
    const WithError<Real> ny = precise_difference_of_products(a.z, b.x, a.x, b.z);
    const WithError<Real> nz = precise_difference_of_products(a.x, b.y, a.y, b.x);
    const WithError<Real> px = exact_product(v.x, nx.value);
    const WithError<Real> py = exact_product(v.y, ny.value);
    const WithError<Real> pz = exact_product(v.z, nz.value);
    const WithError<Real> xy = exact_sum(px.value, py.value);
    const WithError<Real> sum = exact_sum(xy.value, pz.value);
    return sum.value + (sum.error + xy.error + (px.error + py.error + pz.error) +
                        (v.x * nx.error + v.y * ny.error + v.z * nz.error));
}

template <class Real>
NUSSELT_INLINE Real triple_product(const Vec3<Real>& v, const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return v.x * (a.y * b.z - a.z * b.y) + v.y * (a.z * b.x - a.x * b.z) + v.z * (a.x * b.y - a.y * b.x);
}

/// What rounding may have taken from a side of a polygon.
/// \param a, b     vertices from and to which the side leads.
/// \param side     a sum of edges.
/// \param lost     what rounding took from the sum.
/// \param rounding bound on what rounding took from the edges, if they are differences of vertices.
/// \returns what b - a exceeds the side by; `lost` if this is too much for edges that are differences of the vertices.
///          The edges then were there first.
template <class Real>
NUSSELT_INLINE Real excess_of_side(const Real& a, const Real& b, const Real& side, const Real& lost,
                                   const Real& rounding) noexcept {
    const WithError<Real> difference = exact_sum(b, -a);
    const Real excess = (difference.value - side) + difference.error;
    return select(abs(excess - lost) <= rounding, excess, lost);
}
template <class Real>
NUSSELT_INLINE Vec3<Real> excess_of_side(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& side,
                                         const Vec3<Real>& lost, const Vec3<Real>& rounding) noexcept {
    return {excess_of_side(a.x, b.x, side.x, lost.x, rounding.x),
            excess_of_side(a.y, b.y, side.y, lost.y, rounding.y),
            excess_of_side(a.z, b.z, side.z, lost.z, rounding.z)};
}

/// Bound on the rounding errors of the components.
template <class Real>
NUSSELT_INLINE Vec3<Real> rounding_of(const Vec3<Real>& a) noexcept {
    const Real unit = Real(std::numeric_limits<scalar_t<Real>>::epsilon() / 2);
    return {unit * abs(a.x), unit * abs(a.y), unit * abs(a.z)};
}

} // namespace detail

/// Six times the volumes between the origin and the triangles of the fan around vertex 0 of a polygon, with the sign of
/// plane_distance().
template <class Real, int N>
struct FanVolumes {
    Real volume[N - 2];
    mask_t<Real> conclusive; ///< whether refine() would change only the last digits

    FanVolumes() = default;

    NUSSELT_INLINE explicit FanVolumes(const ConvexPolygon<Real, N>& polygon) noexcept {
        const Vec3<Real>& v = polygon.vertex[0];
        Vec3<Real> offset = polygon.edge[0];
        Vec3<Real> normal = cross(offset, polygon.edge[1]);
        volume[0] = multiply_add(v.z, normal.z, multiply_add(v.y, normal.y, v.x * normal.x));
        NUSSELT_UNROLL
        for (int j = 1; j < N - 2; ++j) {
            offset = offset + polygon.edge[j];
            const Vec3<Real> n = cross(offset, polygon.edge[j + 1]);
            volume[j] = multiply_add(v.z, n.z, multiply_add(v.y, n.y, v.x * n.x));
            normal = normal + n;
        }
        const Real whole = total();
        conclusive = whole * whole > Real(kConclusive * kConclusive) * dot(v, v) * dot(normal, normal);
    }

    /// For a polygon whose plane has a known distance.
    NUSSELT_HD FanVolumes(const ConvexPolygon<Real, N>& polygon, const Real& distance) noexcept
        : conclusive(true) {
        Vec3<Real> offset = polygon.edge[0];
        for (int j = 0; j < N - 2; ++j) {
            volume[j] = distance * abs(dot(polygon.normal, cross(offset, polygon.edge[j + 1])));
            offset = offset + polygon.edge[j + 1];
        }
    }

    NUSSELT_INLINE Real total() const noexcept {
        Real sum = volume[0];
        for (int j = 1; j < N - 2; ++j) sum = sum + volume[j];
        return sum;
    }

    /// Computes volumes that are not conclusive once more, with products of twice the precision.
    NUSSELT_HD void refine(const ConvexPolygon<Real, N>& polygon) noexcept {
        const Real distance = plane_distance(polygon);
        const Real side = copysign(Real(1), distance);
        const Vec3<Real>& v = polygon.vertex[0];
        const Vec3<Real> zero{Real(0), Real(0), Real(0)};
        Vec3<Real> offset = polygon.edge[0]; // to vertex j + 1
        Vec3<Real> lost = zero;
        Vec3<Real> rounding = detail::rounding_of(offset);
        NUSSELT_UNROLL
        for (int j = 0; j < N - 2; ++j) {
            const Vec3<Real>& a = polygon.vertex[j + 1];
            const Vec3<Real>& b = polygon.vertex[j + 2];
            const Vec3<Real>& edge = polygon.edge[j + 1];
            const Vec3<Real> edge_rounding = detail::rounding_of(edge);
            const Real exact =
                detail::precise_triple_product(v, offset, edge) +
                (detail::triple_product(v, detail::excess_of_side(v, a, offset, lost, rounding), edge) +
                 detail::triple_product(v, offset, detail::excess_of_side(a, b, edge, zero, edge_rounding)));
            const Real precise = select(distance == Real(0), Real(0), max(side * exact, Real(0)));
            volume[j] = select(conclusive, volume[j], side * precise);
            const auto x = detail::exact_sum(offset.x, edge.x);
            const auto y = detail::exact_sum(offset.y, edge.y);
            const auto z = detail::exact_sum(offset.z, edge.z);
            offset = {x.value, y.value, z.value};
            lost = lost + Vec3<Real>{x.error, y.error, z.error};
            rounding = rounding + edge_rounding;
        }
    }

    /// Least sine of the angle between the plane and the direction to vertex 0 for which rounding can be ignored: it
    /// magnifies rounding errors by the reciprocal. Products that are rounded together with their sum allow twice as much.
    static constexpr scalar_t<Real> kConclusive = scalar_t<Real>(NUSSELT_HAS_FMA ? 1.0 / 256 : 1.0 / 128);
};

NUSSELT_NAMESPACE_END
