#pragma once
/// Radiance of all directions as a square of texels of equal solid angle.
///
/// P. Clarberg 2008, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, Journal of Graphics Tools 13(3),
/// doi:10.1080/2151237X.2008.10129263. As in pbrt-v4, the centre of the square is +z, its corners are -z, and the
/// midpoints of its edges are +-x and +-y. There are no poles where texels crowd together, and all coordinates are
/// found without subtracting numbers that are nearly equal.

#include <nusselt/core/trig.h>
#include <nusselt/emission/texture.h>

NUSSELT_NAMESPACE_BEGIN

/// The unit direction at a point of the square. The map keeps areas: the square has the solid angle 4 pi.
/// \tparam Real float, double, long double or a pack.
/// \param at    in [0, 1]^2.
template <class Real>
NUSSELT_HD inline Vec3<Real> octahedral_direction(const Vec2<Real>& at) noexcept {
    // Distances from the middle of the square and from its edges, in half sides. Both are exact.
    const Vec2<Real> x{Real(2) * at.x - Real(1), Real(2) * at.y - Real(1)};
    const Real edge_x = Real(2) * min(at.x, Real(1) - at.x);
    const Real edge_y = Real(2) * min(at.y, Real(1) - at.y);
    // The triangles around the centre are the upper hemisphere. Those in the corners are mirror images of it.
    const auto upper = edge_x + edge_y >= Real(1);
    const Real a = select(upper, abs(x.x), edge_y);
    const Real b = select(upper, abs(x.y), edge_x);
    const Real r = min(a + b, Real(1));
    const SinCos<Real> azimuth = sincos_quarter_turn(Real(kPi<scalar_t<Real>> / 2) *
                                                     min(b / select(r > Real(0), r, Real(1)), Real(1)));
    const Real across = r * sqrt(Real(2) - r * r);
    const Real height = (Real(1) - r) * (Real(1) + r);
    return {copysign(across * azimuth.cos, x.x), copysign(across * azimuth.sin, x.y),
            select(upper, height, -height)};
}

/// The point of the square for a direction, in [0, 1)^2.
/// \param w unit.
template <class Real>
NUSSELT_HD inline Vec2<Real> octahedral_coordinates(const Vec3<Real>& w) noexcept {
    // r^2 = 1 - |z| without cancellation.
    const Real across = sqrt(w.x * w.x + w.y * w.y);
    const Real r = min(across / sqrt(Real(1) + abs(w.z)), Real(1));
    const Real b = min(r * (Real(2 / kPi<scalar_t<Real>>) * atan2_positive(abs(w.y), abs(w.x))), r);
    const Real a = r - b;
    const auto lower = w.z < Real(0);
    const auto coordinate = [&](const Real& component, const Real& from_middle, const Real& from_edge) {
        const Real half = Real(0.5) * select(lower, from_edge, from_middle);
        const Real low = select(lower, half, Real(0.5) - half);
        const Real high = select(lower, Real(1) - half, Real(0.5) + half);
        return below_one(select(component < Real(0), low, high));
    };
    return {coordinate(w.x, a, b), coordinate(w.y, b, a)};
}

/// The texel at an index that may lie one texel beyond the square: each edge meets its own mirror image.
/// \param i, j from -1 to size.
NUSSELT_HD constexpr Vec2<int> wrap_octahedral(int i, int j, int size) noexcept {
    if (i < 0 || i >= size) {
        i = i < 0 ? 0 : size - 1;
        j = size - 1 - j;
    }
    if (j < 0 || j >= size) {
        j = j < 0 ? 0 : size - 1;
        i = size - 1 - i;
    }
    return {i, j};
}

/// Radiance of all directions. It is interpolated between the centres of texels, also across the edges of the square,
/// and is continuous on the sphere.
template <class T>
struct OctahedralMap {
    const Vec3<T>* texel; ///< radiance per channel [W/(sr m^2)] at index j * size + i. The caller owns it.
    int size;             ///< columns and rows, at least 1

    /// \param i, j from -1 to size.
    NUSSELT_HD const Vec3<T>& at(int i, int j) const noexcept {
        const Vec2<int> wrapped = wrap_octahedral(i, j, size);
        return texel[wrapped.y * size + wrapped.x];
    }

    /// \param point of the square, in [0, 1]^2.
    NUSSELT_HD Vec3<T> lookup(const Vec2<T>& point) const noexcept {
        const T x = point.x * static_cast<T>(size) - T(0.5);
        const T y = point.y * static_cast<T>(size) - T(0.5);
        const int i = detail::floor_to_int(x);
        const int j = detail::floor_to_int(y);
        const T right = x - static_cast<T>(i);
        const T up = y - static_cast<T>(j);
        return (T(1) - up) * ((T(1) - right) * at(i, j) + right * at(i + 1, j)) +
               up * ((T(1) - right) * at(i, j + 1) + right * at(i + 1, j + 1));
    }

    /// \param w unit direction in the space of the map.
    NUSSELT_HD Vec3<T> lookup(const Vec3<T>& w) const noexcept { return lookup(octahedral_coordinates(w)); }
};

NUSSELT_NAMESPACE_END
