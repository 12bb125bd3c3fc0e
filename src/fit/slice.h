#pragma once
/// The data to which one entry of a table is fitted.

namespace nusselt::fit {

/// A BRDF with these parameters, seen from one direction.
struct Slice {
    double roughness;   ///< perceptual, in [0, 1]
    double inclination; ///< of wo [rad], in [0, pi / 2]
    double f0;          ///< reflectance at normal incidence, in [0, 1]
};

/// Integrals over the hemisphere of BRDF times cosine.
struct Moments {
    double albedo;
    double tilt; ///< inclination of the mean direction [rad], away from wo
};

/// An LTC in terms of its shape. Its matrix cosine_from_shading has the rows
///
///     ( cos(peak), 0, sin(peak)) / width_x
///     (         0, 1,         0) / width_y
///     (-sin(tilt), 0, cos(tilt))
///
/// and with all angles in [0, pi / 2) the signs that LtcCoefficients promises.
struct Lobe {
    double peak; ///< inclination of the direction that maps to +z, that of the maximum of narrow lobes [rad]
    double tilt; ///< inclination of the normal of the lobe's own horizon [rad]
    double width_x; ///< tangent of the half angle in the plane of incidence; 1: that of a cosine
    double width_y; ///< and across
};

} // namespace nusselt::fit
