#pragma once
/// Radiance of lights that shine with an intensity profile.
///
/// In its far field, a light of area A and radiance L(w) has the intensity A L(w) cos. So a light whose radiance is
/// the same at each of its points, but depends on the direction, has the intensity of the profile if L = I / (K A
/// cos). (Multiplying a constant radiance by the profile instead would make all luminaires narrower by a cosine.)

#include "scene/model/profiles/intensity_profile.h"

namespace nusselt::scene {

/// K [lm/W]: photometric files count in lumens, scenes in watts. 179 is what Radiance takes for white light.
inline constexpr double kLumensPerWatt = 179;

/// Cosines below that of the library (nusselt/emission/profile_radiance.h) count as this one, which takes 0.013 % of the flux
/// from a Lambertian light.
extern const double kGrazingCosine;

/// The radiance [W/(sr m^2)] of a flat light that emits to the side of +z.
/// \param area       [m^2], positive
/// \param direction  of unit length, in the frame of the profile
/// \returns 0 for directions that do not leave from this side
double flat_radiance(const IntensityProfile& profile, double area, const Double3& direction);

/// The share of the flux that such a light does not emit, in [0, 1]: what leaves from the other side, and what
/// kGrazingCosine takes. 0 for a dark profile.
double share_lost_by_flat_light(const IntensityProfile& profile);

/// Extents of a box in the frame of the profile [m].
struct BoxSize {
    double x, y, z;
};

/// The radiance [W/(sr m^2)] of each face of a box that faces a direction: the intensity over the area of the box as
/// seen from there. The box thus emits sideways and upward what a flat light loses. Areas below kGrazingCosine times
/// that of the largest face count as this.
/// \param size       not negative, with an area
/// \param direction  of unit length, in the frame of the profile
double box_radiance(const IntensityProfile& profile, const BoxSize& size, const Double3& direction);

} // namespace nusselt::scene
