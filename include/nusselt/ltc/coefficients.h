#pragma once
/// The numbers that describe one linearly transformed cosine (LTC).
///
/// E. Heitz, J. Dupuy, S. Hill, D. Neubelt 2016, Real-Time Polygonal-Light Shading with Linearly Transformed Cosines,
/// doi:10.1145/2897824.2925895.

#include <nusselt/core/config.h>

NUSSELT_NAMESPACE_BEGIN

/// The matrix `cosine_from_shading` (M^-1 of the papers) and the albedo of the lobe that it stands for.
///
///     | m00   0  m02 |
///     |  0   m11  0  |     (row, column)
///     | m20   0  m22 |
///
/// It maps a direction w from shading space, where the normal is +z and wo lies in the xz half-plane with x >= 0, to
/// o = cosine_from_shading w in cosine space, where the density is that of a clamped cosine. In shading space the
/// density of the lobe is max(o.z, 0) |det| / (pi |o|^4) [1/sr] for a unit vector w.
///
/// The matrix means the same after multiplication by any positive number: nothing may depend on its scale, but entries
/// are at most of order one or are far from the limits of float. Those of a table fulfil m00, m11, m22 > 0, m02 >= 0
/// and m20 <= 0. Therefore the determinant m11 (m00 m22 - m02 m20) is a sum of products of one sign: it is positive,
/// nothing cancels in it, and all of this holds for interpolated matrices too. The identity is the Lambertian lobe.
///
/// \tparam Real float, double, long double or a pack with one lobe per lane.
template <class Real>
struct LtcCoefficients {
    Real m00, m02;
    Real m11;
    Real m20, m22;
    Real albedo; ///< fraction of the light from all directions that the lobe reflects to the eye, in [0, 1]
};

NUSSELT_NAMESPACE_END
