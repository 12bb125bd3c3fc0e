#ifndef NUSSELT_INTERFACE_PROFILES_H
#define NUSSELT_INTERFACE_PROFILES_H
/// Profiles of lights as emission words (kEmissionWordsBinding), for C++ and GLSL alike: where each part begins. Floats are
/// stored as their bits.

#include "interface/lights.h"

#ifdef __cplusplus
namespace nusselt::interface {
#endif

// A luminaire, see scene::IntensityArrays.
const uint kLuminaireVerticals = 0u;   ///< number of vertical angles, at least two
const uint kLuminaireHorizontals = 1u; ///< number of half-planes, at least two
/// Vertical angles, angles of half-planes, then the intensities of each half-plane.
const uint kLuminaireAngles = 2u;

// How the radiance of a polygon depends on the direction, see scene::ProfiledEmission.
/// x, y and z of the profile, the normal of the polygon and the x axis of the holes of a honeycomb, in world space.
const uint kProfileAxes = 0u;
const uint kProfileInverseSlope = 15u; ///< of the spread, 0 for none
const uint kProfileInverseHoles = 16u; ///< along x and y of the holes, 0 for none
const uint kProfileInverseMean = 18u;  ///< 0 for dark lights
const uint kProfileLuminaire = 19u;    ///< its first word, kNoWords for none
const uint kProfileFaceCount = 20u;
/// Of each face the normal in the frame of the profile, and the area over the least visible one.
const uint kProfileFaces = 21u;
const uint kProfileFaceWords = 4u;

#ifdef __cplusplus
} // namespace nusselt::interface
#endif

#endif
