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

// How the radiance of a polygon, a line or a tube depends on the direction, see scene::ProfiledEmission.
/// x, y and z of the profile, the normal of the light and the x axis of the holes of a honeycomb, in world space.
const uint kProfileAxes = 0u;
const uint kProfileInverseSlope = 15u; ///< of the spread, 0 for none
const uint kProfileInverseHoles = 16u; ///< along x and y of the holes, 0 for none
const uint kProfileInverseMean = 18u;  ///< 0 for dark lights
const uint kProfileLuminaire = 19u;    ///< its first word, kNoWords for none
const uint kProfileTubeSpread = 20u;   ///< the first word of a scene::TubeSpread; kNoWords for none
const uint kProfileRoundAxis = 21u;    ///< of tubes and lines, in the frame of the profile
const uint kProfileRoundArea = 24u;    ///< over the least visible one; 0 for flat shapes
const uint kProfileFaceCount = 25u;
/// Of each face the normal in the frame of the profile, and the area over the least visible one.
const uint kProfileFaces = 26u;
const uint kProfileFaceWords = 4u;

/// A scene::TubeSpread has one number more.
const uint kTubeSpreadCells = 64u;

#ifdef __cplusplus
} // namespace nusselt::interface
#endif

#endif
