#pragma once
/// Radiance of flat lights that have an intensity in their far field, as photometric files give it.

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// Cosines below this one count as this one, or else the radiance of luminaires that shine sideways would be infinite. It takes
/// 1 % of the flux from a hemisphere of constant intensity.
template <class T>
inline constexpr T kGrazingCosine = T(0.02);

/// The radiance, the same at each point, of a flat light with that intensity in the far field: I / (K A max(cos, 0.02)). Make a
/// table of it for WindowedPolygon.
/// \param intensity [cd], or [W/sr] if K is 1; not negative.
/// \param efficacy  K [lm/W], 179 by convention.
/// \param area      A of the light [m^2], positive.
/// \param cosine    of the direction with the normal of the light.
/// \returns [W/(sr m^2)], 0 for directions that leave from the other side.
template <class T>
NUSSELT_HD inline T profile_radiance(const T& intensity, const T& efficacy, const T& area,
                                     const T& cosine) noexcept {
    return cosine > T(0) ? intensity / (efficacy * area * max(cosine, kGrazingCosine<T>)) : T(0);
}

NUSSELT_NAMESPACE_END
