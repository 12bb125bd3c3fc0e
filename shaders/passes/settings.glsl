#ifndef NUSSELT_PASSES_SETTINGS_GLSL
#define NUSSELT_PASSES_SETTINGS_GLSL
/// What is chosen when a pipeline is made: the numbers of the enumerations in src/render/settings.h. Those of samplers and
/// heuristics are in shaders/nusselt.

layout(constant_id = 0) const int kTechnique = 0;
layout(constant_id = 1) const int kStrategies = 0;
layout(constant_id = 2) const int kMis = 0;
layout(constant_id = 3) const int kSampler = 0;
layout(constant_id = 4) const int kBrdf = 0;
// Kinds of lights that the scene has: without the others, drivers compile much faster.
layout(constant_id = 5) const bool kHasPolygons = true;
layout(constant_id = 6) const bool kHasLines = true;
layout(constant_id = 7) const bool kHasTubes = true;

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
