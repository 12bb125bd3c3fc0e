#pragma once
/// From the angles of an IES file to directions.

#include "scene/import/ies/ies_file.h"
#include "scene/model/profiles/intensity_profile.h"

namespace nusselt::scene {

/// The profile of a file, mirrored as its symmetry says.
///
/// Directions of the types, in the frame of IntensityProfile; v and h are vertical and horizontal angles:
///
///     C: ( sin v cos h, -sin v sin h, cos v       )
///     B: ( cos h sin v,  sin h,       cos h cos v )
///     A: ( sin v,        cos v sin h, cos v cos h )
///
/// So, looking along the beam with the half-plane of 0 degrees upward, positive vertical angles of A and B are up and
/// positive horizontal ones are right. These types are sampled at the angles of type C, in steps of the smallest step
/// of the file, but of 0.25 degrees at least and 1 degree at most; outside of their angles the profile is dark.
IntensityProfile make_profile(const IesFile& file);

} // namespace nusselt::scene
