#ifndef NUSSELT_PASSES_ROUNDS_ROUND_RECORDS_GLSL
#define NUSSELT_PASSES_ROUNDS_ROUND_RECORDS_GLSL
/// The round lights of a scene, and whether it has any.

#ifndef ROUND_LIGHTS
#error ROUND_LIGHTS must be 1 for scenes with spheres, disks, ellipses or ellipsoids that emit, else 0: those shaders are larger
#endif

#include "interface/lights.h"

#if ROUND_LIGHTS
layout(constant_id = kEllipsesConstant) const bool kHasEllipses = true;
layout(constant_id = kEllipsoidsConstant) const bool kHasEllipsoids = true;
const bool kHasRounds = kHasEllipses || kHasEllipsoids;

layout(set = 0, binding = kRoundLightsBinding, std430) readonly buffer RoundLights { RoundLightRecord round_lights[]; };
#else
const bool kHasRounds = false;
#endif

#endif
