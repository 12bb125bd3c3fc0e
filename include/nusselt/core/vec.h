#pragma once
/// Vectors of two and three components over any Real, and products that keep full relative precision.

#include <nusselt/core/real.h>

NUSSELT_NAMESPACE_BEGIN

template <class Real>
struct Vec2 {
    Real x, y;
};

template <class Real>
struct Vec3 {
    Real x, y, z;
};

template <class Real>
NUSSELT_HD constexpr Vec2<Real> operator+(const Vec2<Real>& a, const Vec2<Real>& b) noexcept {
    return {a.x + b.x, a.y + b.y};
}
template <class Real>
NUSSELT_HD constexpr Vec2<Real> operator-(const Vec2<Real>& a, const Vec2<Real>& b) noexcept {
    return {a.x - b.x, a.y - b.y};
}
template <class Real>
NUSSELT_HD constexpr Vec2<Real> operator*(const Real& s, const Vec2<Real>& a) noexcept {
    return {s * a.x, s * a.y};
}
template <class Real>
NUSSELT_HD constexpr Vec2<Real> operator*(const Vec2<Real>& a, const Real& s) noexcept {
    return s * a;
}
template <class Real>
NUSSELT_HD constexpr Vec2<Real> operator/(const Vec2<Real>& a, const Real& s) noexcept {
    return {a.x / s, a.y / s};
}
template <class Real>
NUSSELT_HD constexpr Vec2<Real>& operator+=(Vec2<Real>& a, const Vec2<Real>& b) noexcept {
    return a = a + b;
}
template <class Real>
NUSSELT_HD constexpr Vec2<Real>& operator-=(Vec2<Real>& a, const Vec2<Real>& b) noexcept {
    return a = a - b;
}
template <class Real>
NUSSELT_HD constexpr Vec2<Real>& operator*=(Vec2<Real>& a, const Real& s) noexcept {
    return a = a * s;
}
template <class Real>
NUSSELT_HD constexpr Vec2<Real>& operator/=(Vec2<Real>& a, const Real& s) noexcept {
    return a = a / s;
}
template <class Real>
NUSSELT_INLINE constexpr Real dot(const Vec2<Real>& a, const Vec2<Real>& b) noexcept {
    return multiply_add(a.y, b.y, a.x * b.x);
}

template <class Real>
NUSSELT_HD constexpr Vec3<Real> operator+(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real> operator-(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real> operator-(const Vec3<Real>& a) noexcept {
    return {-a.x, -a.y, -a.z};
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real> operator*(const Real& s, const Vec3<Real>& a) noexcept {
    return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real> operator*(const Vec3<Real>& a, const Real& s) noexcept {
    return s * a;
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real> operator/(const Vec3<Real>& a, const Real& s) noexcept {
    return {a.x / s, a.y / s, a.z / s};
}
/// Component by component, for colours.
template <class Real>
NUSSELT_HD constexpr Vec3<Real> operator*(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real>& operator+=(Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return a = a + b;
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real>& operator-=(Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return a = a - b;
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real>& operator*=(Vec3<Real>& a, const Real& s) noexcept {
    return a = a * s;
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real>& operator/=(Vec3<Real>& a, const Real& s) noexcept {
    return a = a / s;
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real>& operator*=(Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return a = a * b;
}
/// s * a + b, each component rounded once.
template <class Real>
NUSSELT_INLINE Vec3<Real> fma(const Real& s, const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {fma(s, a.x, b.x), fma(s, a.y, b.y), fma(s, a.z, b.z)};
}
/// s * a + b as multiply_add() computes it.
template <class Real>
NUSSELT_INLINE Vec3<Real> multiply_add(const Real& s, const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {multiply_add(s, a.x, b.x), multiply_add(s, a.y, b.y), multiply_add(s, a.z, b.z)};
}
template <class Real>
NUSSELT_INLINE constexpr Real dot(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return multiply_add(a.z, b.z, multiply_add(a.y, b.y, a.x * b.x));
}
template <class Real>
NUSSELT_HD constexpr Vec2<Real> xy(const Vec3<Real>& a) noexcept {
    return {a.x, a.y};
}

template <class Real>
NUSSELT_HD constexpr Vec2<Real> select(const mask_t<Real>& mask, const Vec2<Real>& a,
                                       const Vec2<Real>& b) noexcept {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y)};
}
template <class Real>
NUSSELT_HD constexpr Vec3<Real> select(const mask_t<Real>& mask, const Vec3<Real>& a,
                                       const Vec3<Real>& b) noexcept {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// The smaller one of each pair of components.
template <class Real>
NUSSELT_HD constexpr Vec3<Real> min(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
/// The larger one of each pair of components.
template <class Real>
NUSSELT_HD constexpr Vec3<Real> max(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}

/// 2^(-3/4 of the exponent range).
template <class Scalar>
inline constexpr Scalar kTiny = power_of_two<Scalar>(-std::numeric_limits<Scalar>::max_exponent / 4 * 3);

/// Determinant of the matrix with columns a, b; accurate to 1.5 ulp, exact sign.
template <class Real>
NUSSELT_INLINE Real det(const Vec2<Real>& a, const Vec2<Real>& b) noexcept {
    return difference_of_products(a.x, b.y, a.y, b.x);
}

/// Each component accurate to 1.5 ulp, exact signs.
template <class Real>
NUSSELT_INLINE Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
            difference_of_products(a.x, b.y, a.y, b.x)};
}

/// x, or 0 if it is below 2^(-3/4 of the exponent range): next to numbers of order one, products with it would
/// underflow, and with denormal numbers flushed to zero even x itself might not survive.
template <class Real>
NUSSELT_INLINE Real without_tiny(const Real& x) noexcept {
    return select(abs(x) < Real(kTiny<scalar_t<Real>>), Real(0), x);
}
template <class Real>
NUSSELT_INLINE Vec3<Real> without_tiny(const Vec3<Real>& a) noexcept {
    return {without_tiny(a.x), without_tiny(a.y), without_tiny(a.z)};
}

/// Euclidean norm without over- or underflow of the squares; 0 for the zero vector.
template <class Real>
NUSSELT_INLINE Real length(const Vec3<Real>& a) noexcept {
    const Real extent = max(max(abs(a.x), abs(a.y)), abs(a.z));
    const Real down = reciprocal_power_of_two(extent);
    const Vec3<Real> scaled = down * a;
    return sqrt(dot(scaled, scaled)) / down;
}

/// Reciprocal of the Euclidean norm of a vector of order one or less; 0 where all components are below kTiny.
template <class Real>
NUSSELT_INLINE Real inverse_length(const Vec3<Real>& a) noexcept {
    const Real squared = dot(a, a);
    const auto safe = squared > Real(kTiny<scalar_t<Real>>);
    Real inverse = Real(1) / sqrt(select(safe, squared, Real(1)));
    if (!all(safe)) {
        const Real extent = max(max(abs(a.x), abs(a.y)), abs(a.z));
        const auto nonzero = extent >= Real(kTiny<scalar_t<Real>>);
        const Real up = reciprocal_power_of_two(select(nonzero, extent, Real(1)));
        const Real scaled_squared = select(nonzero, dot(up * a, up * a), Real(1));
        inverse = select(safe, inverse, select(nonzero, up / sqrt(scaled_squared), Real(0)));
    }
    return inverse;
}

/// Unit vector, or the zero vector if a is zero; any finite length is fine.
template <class Real>
NUSSELT_INLINE Vec3<Real> normalize(const Vec3<Real>& a) noexcept {
    const Real extent = max(max(abs(a.x), abs(a.y)), abs(a.z));
    const Vec3<Real> scaled = reciprocal_power_of_two(extent) * a;
    const Real squared = dot(scaled, scaled);
    const Real factor = select(squared > Real(0), Real(1) / sqrt(squared), Real(0));
    return factor * scaled;
}

/// Calls visit(member of to, member of from) for all members of two records.
template <class To, class From, class Visit>
NUSSELT_INLINE void visit_members(Vec3<To>& to, const Vec3<From>& from, const Visit& visit) noexcept {
    visit(to.x, from.x);
    visit(to.y, from.y);
    visit(to.z, from.z);
}

/// The same vector in every lane of a pack, or in another precision.
template <class Real, class Single>
NUSSELT_HD constexpr Vec3<Real> broadcast(const Vec3<Single>& a) noexcept {
    return {Real(a.x), Real(a.y), Real(a.z)};
}
/// \copydoc broadcast
template <class Real, class Single>
NUSSELT_HD constexpr Vec2<Real> broadcast(const Vec2<Single>& a) noexcept {
    return {Real(a.x), Real(a.y)};
}

NUSSELT_NAMESPACE_END
