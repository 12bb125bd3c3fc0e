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
const uint kProfileAxes = 0u; ///< x, y and z of the profile and the normal of the polygon, in world space
const uint kProfileInverseSlope = 12u; ///< of the spread, 0 for none
const uint kProfileInverseMean = 13u;  ///< 0 for dark lights
const uint kProfileLuminaire = 14u;    ///< its first word, kNoWords for none
const uint kProfileFaceCount = 15u;
/// Of each face the normal in the frame of the profile, and the area over the least visible one.
const uint kProfileFaces = 16u;
const uint kProfileFaceWords = 4u;

#ifdef __cplusplus
} // namespace nusselt::interface
#endif

#endif
