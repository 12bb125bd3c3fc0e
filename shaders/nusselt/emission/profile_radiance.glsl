#ifndef NUSSELT_EMISSION_PROFILE_RADIANCE_GLSL
#define NUSSELT_EMISSION_PROFILE_RADIANCE_GLSL
// Follows include/nusselt/emission/profile_radiance.h @ 28099bc4db16
/// Radiance of flat lights that have an intensity in their far field. Twin of
/// include/nusselt/emission/profile_radiance.h, which explains it.

#include "../core/real.glsl"

/// Cosines below this one count as this one.
const float kNusseltGrazingCosine = 0.02;

/// \param intensity [cd], or [W/sr] if the efficacy is 1; not negative.
/// \param efficacy  [lm/W], 179 by convention.
/// \param area      of the light [m^2], positive.
/// \param cosine    of the direction with the normal of the light.
/// \return [W/(sr m^2)], 0 for directions that leave from the other side.
float profile_radiance(float intensity, float efficacy, float area, float cosine) {
    return cosine > 0.0 ? intensity / (efficacy * area * nusselt_max(cosine, kNusseltGrazingCosine)) : 0.0;
}

#endif
