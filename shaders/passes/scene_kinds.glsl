#ifndef NUSSELT_PASSES_SCENE_KINDS_GLSL
#define NUSSELT_PASSES_SCENE_KINDS_GLSL
/// What a scene has, known when pipelines are made: drivers leave out the code for all else. Some of them run both sides of
/// every branch, and registers are few.

layout(constant_id = 0) const bool kHasPolygons = true; ///< lights
layout(constant_id = 1) const bool kHasLines = true;    ///< linear lights without extent
layout(constant_id = 2) const bool kHasTubes = true;
layout(constant_id = 3) const bool kHasInstances = true;
layout(constant_id = 4) const bool kHasPartial = true;   ///< surfaces that are only partly there
layout(constant_id = 5) const bool kHasFrostbite = true; ///< materials with a specular component
layout(constant_id = 6) const uint kTextureKinds = ~0u;  ///< as MaterialRecord::texture_kinds, of all materials together

#endif
