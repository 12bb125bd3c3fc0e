#ifndef NUSSELT_LTC_COEFFICIENTS_GLSL
#define NUSSELT_LTC_COEFFICIENTS_GLSL
// Follows include/nusselt/ltc/coefficients.h @ 780a83e305b0
/// The numbers that describe one linearly transformed cosine (LTC). Twin of include/nusselt/ltc/coefficients.h, where
/// the conditions on them stand.

#include "../core/compatibility.glsl"

/// The matrix `cosine_from_shading` (M^-1 of the papers) and the albedo of the lobe that it stands for.
///
///     | m00   0  m02 |
///     |  0   m11  0  |     (row, column)
///     | m20   0  m22 |
struct LtcCoefficients {
    float m00, m02;
    float m11;
    float m20, m22;
    float albedo; ///< fraction of the light from all directions that the lobe reflects to the eye, in [0, 1]
};

#endif
