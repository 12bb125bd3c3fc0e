#ifndef NUSSELT_PASSES_SCENE_KINDS_GLSL
#define NUSSELT_PASSES_SCENE_KINDS_GLSL
/// What a scene has, besides kinds of light. It is known when a pipeline is made, so that the driver removes the code for the
/// rest: some drivers run both sides of every branch, and registers are scarce.

#include "interface/settings.h"

layout(constant_id = kInstancesConstant) const bool kHasInstances = true;
layout(constant_id = kPartialConstant) const bool kHasPartial = true; ///< surfaces with an alpha below 1
layout(constant_id = kFrostbiteConstant) const bool kHasFrostbite = true; ///< materials of the Frostbite model
layout(constant_id = kPhongConstant) const bool kHasPhong = true; ///< materials of the Phong model
layout(constant_id = kTextureKindsConstant) const uint kTextureKinds = ~0u; ///< MaterialRecord::texture_kinds of all materials

#endif
