#ifndef NUSSELT_PASSES_SETTINGS_GLSL
#define NUSSELT_PASSES_SETTINGS_GLSL
/// What is chosen when a pipeline is made: the numbers of the enumerations in src/render/settings.h. Those of samplers and
/// heuristics are in shaders/nusselt.

// After those of scene_kinds.glsl.
layout(constant_id = 7) const int kTechnique = 0;
layout(constant_id = 8) const int kStrategies = 0;
layout(constant_id = 9) const int kMis = 0;
layout(constant_id = 10) const int kSampler = 0;
layout(constant_id = 11) const int kBrdf = 0;

const int kTechniqueArea = 0;
const int kTechniqueSolidAngle = 1;
const int kTechniqueClippedSolidAngle = 2;
const int kTechniqueProjectedSolidAngle = 3;
const int kTechniqueProjectedSolidAngleBiased = 4;
const int kTechniqueLtcAnalytic = 5;

const int kStrategiesDiffuse = 0;
const int kStrategiesDiffuseLtc = 1;
const int kStrategiesDiffuseGgx = 2;
const int kStrategiesDiffuseGgxBounded = 3;

const int kBrdfLambert = 1;

#endif
