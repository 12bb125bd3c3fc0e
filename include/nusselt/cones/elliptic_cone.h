#pragma once
/// Elliptic cones: what a point sees of a disk, an ellipse, a sphere or an ellipsoid.
///
/// An ellipse C + sigma U + tau V with sigma^2 + tau^2 <= 1 fills the directions B (sigma, tau, 1) with the columns
/// B = [U V C]. A Lorentz matrix L maps the unit disk to itself, so that B L describes the same cone. A cone is stored
/// as the L that makes the columns orthogonal. The quadric B^-T J B^-1, J = diag(1, 1, -1), is never formed: a light
/// of the angular size s has entries of order s^-2 next to -1 there, and float would lose it at s = 3e-4. The Jacobi
/// method is that of I. Slapnicar and N. Truhar 2000, Relative perturbation theory for hyperbolic singular value
/// problem, doi:10.1016/S0024-3795(99)00138-2, with one more closed form, that of disks, which takes a single
/// rotation.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/frame.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// sqrt(x^2 + y^2) without underflow of the squares, for numbers of order one and less.
template <class Real>
NUSSELT_INLINE Real hypotenuse(const Real& x, const Real& y) noexcept {
    const Real larger = max(abs(x), abs(y));
    const Real ratio = min(abs(x), abs(y)) / select(larger > Real(0), larger, Real(1));
    return larger * sqrt(multiply_add(ratio, ratio, Real(1)));
}

/// numerator / denominator, or 0 unless the denominator is positive.
template <class Real>
NUSSELT_INLINE Real over_positive(const Real& numerator, const Real& denominator) noexcept {
    const auto positive = denominator > Real(0);
    return select(positive, numerator / select(positive, denominator, Real(1)), Real(0));
}

} // namespace detail

/// The cone of directions c e3 + a s e1 + b t e2 with s^2 + t^2 <= 1. a / c and b / c are the tangents of its
/// half-angles; c = 0 is a half-space. The points (s, t) are those of the disk of the cone.
template <class Real>
struct EllipticCone {
    Vec3<Real> e1, e2, e3;   ///< right-handed, orthonormal; e3 is the axis
    Real a, b, c;            ///< not negative, the largest is 1; a = 0 or b = 0: the light is seen edge-on
    Vec3<Real> row[3];       ///< of the Lorentz matrix L
    mask_t<Real> is_visible; ///< false for a light without extent, and on its rim

    /// The point (sigma, tau) of the unit disk from which the light was made.
    /// \param disk a point of the disk of the cone.
    NUSSELT_HD Vec2<Real> to_light(const Vec2<Real>& disk) const noexcept {
        const auto of_row = [&](const Vec3<Real>& r) {
            return multiply_add(r.x, disk.x, multiply_add(r.y, disk.y, r.z));
        };
        const Real z = of_row(row[2]);
        const Real inverse = Real(1) / select(z > Real(0), z, Real(1));
        const Vec2<Real> p{of_row(row[0]) * inverse, of_row(row[1]) * inverse};
        const Real squared = dot(p, p);
        return select(squared > Real(1), Real(1) / sqrt(max(squared, Real(1))), Real(1)) * p;
    }

    /// The direction of a point of the disk, not of unit length.
    NUSSELT_HD Vec3<Real> direction(const Vec2<Real>& disk) const noexcept {
        return (a * disk.x) * e1 + (b * disk.y) * e2 + c * e3;
    }

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.e1, self.e2, self.e3, self.a, self.b, self.c, self.row, self.is_visible);
    }
};

namespace detail {

/// Angles up to this one may be a matter of rounding.
template <class Real>
inline constexpr auto kConeRounding = 8 * std::numeric_limits<scalar_t<Real>>::epsilon();

/// The heights of the axes of a cone above the horizon z = 0. Those of e1 and e2 are 0 if the cone is a half-space up to
/// rounding, and rounding may cause them: otherwise, the horizon would cut half-spaces whose rim lies in it.
template <class Real>
NUSSELT_INLINE Vec3<Real> heights_of_axes(const EllipticCone<Real>& cone) noexcept {
    const auto is_half_space = cone.c < Real(kConeRounding<Real>);
    const auto significant = [&](const Real& height) {
        return select(is_half_space & (abs(height) <= Real(kConeRounding<Real>)), Real(0), height);
    };
    return {significant(cone.e1.z), significant(cone.e2.z), cone.e3.z};
}

} // namespace detail

template <class Real, class Single>
NUSSELT_INLINE EllipticCone<Real> broadcast(const EllipticCone<Single>& cone) noexcept {
    return {broadcast<Real>(cone.e1),
            broadcast<Real>(cone.e2),
            broadcast<Real>(cone.e3),
            Real(cone.a),
            Real(cone.b),
            Real(cone.c),
            {broadcast<Real>(cone.row[0]), broadcast<Real>(cone.row[1]), broadcast<Real>(cone.row[2])},
            mask_t<Real>(cone.is_visible)};
}

namespace detail {

/// The columns of B L and the rows of L while they become orthogonal.
template <class Real>
struct ConeColumns {
    Vec3<Real> u, v, c;
    Vec3<Real> row[3];

    /// Rotates u and v by less than 45 degrees, so that they become perpendicular. Those of a circle stay as they are,
    /// for rounding would turn them anyhow, and samples of neighbouring points would have nothing in common.
    NUSSELT_HD void turn() noexcept {
        const Real both = dot(u, v);
        const Real difference = dot(u - v, u + v);
        const Real rounding =
            Real(4 * std::numeric_limits<scalar_t<Real>>::epsilon()) * (dot(u, u) + dot(v, v));
        const Real denominator = abs(difference) + hypotenuse(difference, both + both);
        const Real ratio =
            select(denominator > rounding, over_positive(abs(both + both), denominator), Real(0));
        const Real tangent = copysign(ratio, both * difference);
        const Real cosine = Real(1) / sqrt(multiply_add(tangent, tangent, Real(1)));
        const Real sine = tangent * cosine;
        const Vec3<Real> turned = cosine * u + sine * v;
        v = cosine * v - sine * u;
        u = turned;
        for (Vec3<Real>& r : row) {
            const Real x = cosine * r.x + sine * r.y;
            r.y = cosine * r.y - sine * r.x;
            r.x = x;
        }
    }

    /// Makes a column perpendicular to c by a Lorentz boost. The root is that of (x^2 + c^2)^2 - 4 (x c)^2: nothing
    /// cancels.
    /// \param entry the entry of a row that belongs to the column.
    template <class Entry>
    NUSSELT_HD void boost(Vec3<Real>& x, const Entry& entry) noexcept {
        const Real both = dot(x, c);
        const Vec3<Real> less = c - x;
        const Vec3<Real> more = c + x;
        const Real root = sqrt(dot(less, less)) * sqrt(dot(more, more));
        const Real h = -copysign(over_positive(abs(both + both), dot(x, x) + dot(c, c) + root), both);
        // The square of 1 - h^2 is a number only if the point is not on the rim of the light.
        const Real complement = (Real(1) - h) * (Real(1) + h);
        const Real g =
            Real(1) / sqrt(max(complement, Real(std::numeric_limits<scalar_t<Real>>::epsilon() / 64)));
        const Vec3<Real> boosted = g * (x + h * c);
        c = g * (c + h * x);
        x = boosted;
        for (Vec3<Real>& r : row) {
            const Real l = g * (entry(r) + h * r.z);
            r.z = g * (r.z + h * entry(r));
            entry(r) = l;
        }
    }
};

/// Orthonormal axes of columns that are almost orthogonal, the longer ones first.
template <class Real>
NUSSELT_HD inline EllipticCone<Real> cone_of_columns(ConeColumns<Real> k, const Vec3<Real>& front) noexcept {
    EllipticCone<Real> cone;
    const Real a = length(k.u), b = length(k.v), c = length(k.c);
    const auto c_first = (c >= a) & (c >= b);
    const auto u_first = a >= b;

    // In cyclic order, starting with the longest: the first, and the longer one of the other two.
    const auto choose = [&](const auto& of_c, const auto& of_u, const auto& of_v) {
        return select(c_first, of_c, select(u_first, of_u, of_v));
    };
    const Vec3<Real> first = normalize(choose(k.c, k.u, k.v));
    const Vec3<Real> second = choose(k.u, k.v, k.c), third = choose(k.v, k.c, k.u);
    const auto in_order = choose(a, b, c) >= choose(b, c, a);
    // Their cross product is perpendicular to the first even if the columns are almost parallel.
    const Vec3<Real> across = normalize(cross(first, normalize(select(in_order, second, third))));
    const auto is_line = dot(across, across) == Real(0);
    const Vec3<Real> normal = select(is_line, Frame<Real>::from_normal(first).b, across);
    const Vec3<Real> along = cross(normal, first);
    const Vec3<Real> axis2 = select(in_order, along, -normal);
    const Vec3<Real> axis3 = select(in_order, normal, along);
    cone.e1 = select(c_first, axis2, select(u_first, first, axis3));
    cone.e2 = select(c_first, axis3, select(u_first, axis2, first));
    cone.e3 = select(c_first, first, select(u_first, axis3, axis2));

    // The axes are right-handed; the columns need not be. A half-space has no centre: the side of the light decides.
    const Vec3<Real> centre = select(c > Real(0), k.c, front);
    const Real down = select(dot(cone.e3, centre) < Real(0), Real(-1), Real(1));
    cone.e3 = down * cone.e3;
    cone.e1 = down * cone.e1;
    const Real flip1 = select(dot(cone.e1, k.u) < Real(0), Real(-1), Real(1));
    const Real flip2 = select(dot(cone.e2, k.v) < Real(0), Real(-1), Real(1));
    for (int i = 0; i < 3; ++i) cone.row[i] = {flip1 * k.row[i].x, flip2 * k.row[i].y, k.row[i].z};

    const Real largest = max(max(a, b), c);
    cone.is_visible = (largest > Real(0)) & is_finite(largest);
    const Real inverse = Real(1) / select(cone.is_visible, largest, Real(1));
    // Denormal numbers have too few digits.
    cone.a = without_tiny(inverse * a);
    cone.b = without_tiny(inverse * b);
    cone.c = without_tiny(inverse * c);
    return cone;
}

} // namespace detail

/// The cone of an ellipse. Four sweeps of the Jacobi method leave errors of a few roundings; for ellipses closer than
/// 1e-3 of their size, float has errors of the rounding over the distance relative to the size.
/// \param u, v   conjugate semi-diameters of an ellipse.
/// \param centre relative to the origin; all with coordinates of order one.
/// \param front  a vector to the side of the cone where the light is, should the origin lie in the plane of the
///               ellipse.
template <class Real>
NUSSELT_HD inline EllipticCone<Real> cone_of_ellipse(const Vec3<Real>& u, const Vec3<Real>& v,
                                                     const Vec3<Real>& centre,
                                                     const Vec3<Real>& front) noexcept {
    constexpr bool kIsFloat = std::is_same_v<scalar_t<Real>, float>;
    constexpr int kSweeps = kIsFloat ? 4 : std::is_same_v<scalar_t<Real>, double> ? 5 : 6;
    const Real one = Real(1), zero = Real(0);
    detail::ConeColumns<Real> k{u, v, centre, {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
    for (int i = 0; i < kSweeps; ++i) {
        k.turn();
        k.boost(k.u, [](Vec3<Real>& r) -> Real& { return r.x; });
        k.boost(k.v, [](Vec3<Real>& r) -> Real& { return r.y; });
    }
    return detail::cone_of_columns(k, front);
}

/// The cone of a sphere: circular.
/// \param sine     radius over distance of the centre, at most 1.
/// \param cosine   sqrt(1 - sine^2)
/// \param to_light the rows of a matrix that rotates the disk of the cone to that of the light.
template <class Real>
NUSSELT_HD inline EllipticCone<Real> cone_of_circle(const Frame<Real>& frame, const Real& sine,
                                                    const Real& cosine) noexcept {
    const Real inverse = Real(1) / max(max(sine, cosine), Real(std::numeric_limits<scalar_t<Real>>::min()));
    const Real zero = Real(0), one = Real(1);
    return {frame.t,
            frame.b,
            frame.n,
            inverse * sine,
            inverse * sine,
            inverse * cosine,
            {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}},
            sine > Real(0)};
}

/// The cone of a disk, and the semi-diameters of the disk to which EllipticCone::to_light() refers.
template <class Real>
struct DiskCone {
    EllipticCone<Real> cone;
    Vec3<Real> u, v;
};

/// A single boost along the direction from the foot of the origin to the centre. Lengths to the nearest and the
/// farthest point of the rim give all parameters without cancellation, edge-on, near and far.
/// \param centre, radius of order one.
/// \param normal unit, either side.
template <class Real>
NUSSELT_HD inline DiskCone<Real> cone_of_disk(const Vec3<Real>& centre, const Vec3<Real>& normal,
                                              const Real& radius) noexcept {
    using Scalar = scalar_t<Real>;
    const Vec3<Real> side = cross(normal, centre);
    const Real p = length(side);
    const Real signed_height = dot(normal, centre);
    const Real h = abs(signed_height);
    // Next to the axis, the direction of denormal numbers would be one of rounding.
    const Vec3<Real> e2 =
        select(p > Real(kTiny<Scalar>), normalize(side), Frame<Real>::from_normal(normal).t);
    const Vec3<Real> m = cross(e2, normal);
    // Squares that underflow belong to points on the rim.
    const Real near = sqrt(multiply_add(h, h, (p - radius) * (p - radius)));
    const Real far = sqrt(multiply_add(h, h, (p + radius) * (p + radius)));
    const Real distance = length(centre);
    const Real power = (distance - radius) * (distance + radius);
    const auto within = power < Real(0);

    // Half of the angle between the rays to the nearest and the farthest point.
    const Real across = Real(2) * radius * h, along = near * far + abs(power);
    const Real norm = sqrt(multiply_add(across, across, along * along));
    const auto visible = (norm > Real(0)) & (near > Real(0)) & (radius > Real(0));
    const Real inverse_norm = Real(1) / select(visible, norm, Real(1));
    const Real product = select(visible, near * far, Real(1));
    const Real sum = select(visible, near + far, Real(1));
    const Real delta = (Real(4) * radius * p) / (sum * sum); // the hyperbolic tangent of the rapidity
    const Real inverse_mean = Real(1) / sqrt(product);
    const Real gain = Real(0.5) * sum * inverse_mean;

    DiskCone<Real> result;
    EllipticCone<Real>& cone = result.cone;
    cone.a = select(within, along, across) * inverse_norm;
    cone.c = select(within, across, along) * inverse_norm;
    cone.b = radius * inverse_mean;

    // The bisector of both rays. From afar the height of the centre has to survive; close by, the direction of the
    // normal.
    Vec3<Real> bisector = centre - (delta * radius) * m;
    if (any(within)) {
        const auto over_disk = p < radius;
        const Real lateral =
            select(over_disk,
                   detail::over_positive(Real(4) * h * radius * p, (p + radius) * near + (radius - p) * far),
                   (p - radius) * far + (p + radius) * near);
        const Real upright = copysign(select(over_disk, sum, h * sum), signed_height);
        bisector = select(within, lateral * m + upright * normal, bisector);
    }
    const Vec3<Real> axis = normalize(bisector);
    cone.e3 = select(dot(axis, axis) > Real(0), axis, normal);
    // The axis keeps its height; the others are perpendicular to it.
    const Vec3<Real> e1 = normalize(cross(e2, cone.e3));
    cone.e2 = cross(cone.e3, e1);
    const Real flip = select(dot(e1, m) < Real(0), Real(-1), Real(1));
    cone.e1 = e1;
    const Real zero = Real(0);
    cone.row[0] = {flip * gain, zero, -gain * delta};
    cone.row[1] = {zero, Real(1), zero};
    cone.row[2] = {-flip * gain * delta, zero, gain};
    cone.is_visible = visible & is_finite(norm);
    const Real largest = max(max(cone.a, cone.b), max(cone.c, Real(std::numeric_limits<Scalar>::min())));
    const Real inverse = Real(1) / largest;
    cone.a = without_tiny(inverse * cone.a);
    cone.b = without_tiny(inverse * cone.b);
    cone.c = without_tiny(inverse * cone.c);
    result.u = radius * m;
    result.v = radius * e2;
    return result;
}

NUSSELT_NAMESPACE_END
