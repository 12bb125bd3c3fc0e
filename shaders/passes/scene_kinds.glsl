#ifndef NUSSELT_PASSES_SCENE_KINDS_GLSL
#define NUSSELT_PASSES_SCENE_KINDS_GLSL
/// What a scene has, known when pipelines are made: drivers leave out the code for all else. Some of them run both sides of
/// every branch, and registers are few.

#include "interface/settings.h"

layout(constant_id = kPolygonsConstant) const bool kHasPolygons = true; ///< lights
layout(constant_id = kLinesConstant) const bool kHasLines = true;    ///< linear lights without extent
layout(constant_id = kTubesConstant) const bool kHasTubes = true;
layout(constant_id = kInstancesConstant) const bool kHasInstances = true;
layout(constant_id = kPartialConstant) const bool kHasPartial = true;   ///< surfaces that are only partly there
layout(constant_id = kFrostbiteConstant) const bool kHasFrostbite = true; ///< materials with a specular component
layout(constant_id = kTextureKindsConstant) const uint kTextureKinds = ~0u;  ///< as MaterialRecord::texture_kinds, of all materials together

#endif
