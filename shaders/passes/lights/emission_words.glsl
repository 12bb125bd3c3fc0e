#ifndef NUSSELT_PASSES_LIGHTS_EMISSION_WORDS_GLSL
#define NUSSELT_PASSES_LIGHTS_EMISSION_WORDS_GLSL
/// Texels of emission that varies, and what sampling needs to know about them.

#include "passes/scene.glsl"

layout(set = 0, binding = kEmissionWordsBinding, std430) readonly buffer EmissionWords { uint emission_words[]; };

/// Radiance of a texel [W/(sr m^2)].
vec3 emission_texel(uint first_texel, uint index) {
    uint at = first_texel + 3u * index;
    return vec3(uintBitsToFloat(emission_words[at]), uintBitsToFloat(emission_words[at + 1u]),
                uintBitsToFloat(emission_words[at + 2u]));
}

#endif
