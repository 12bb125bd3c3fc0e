#pragma once
/// Sums and products that keep what rounding takes from them, for the sides of polygons. Where a light is almost seen
/// edge-on, the digits that rounding takes are all that counts.

#include <nusselt/core/vec.h>

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

NUSSELT_NAMESPACE_END
