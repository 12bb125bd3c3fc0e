#version 450
#extension GL_GOOGLE_include_directive : require
#include "nusselt/random/pcg.glsl"
#include "nusselt/random/sobol.glsl"
#include "nusselt/random/unit_interval.glsl"
#include "parity/buffers.glsl"

// Inputs: the bits of four words, a number in [0, 1).
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uvec4 key = uvec4(floatBitsToUint(inputs[5u * i]), floatBitsToUint(inputs[5u * i + 1u]),
                            floatBitsToUint(inputs[5u * i + 2u]), floatBitsToUint(inputs[5u * i + 3u]));
    const uvec4 hash = pcg4d(key);
    const uvec2 plain = sobol(key.x);
    const uvec2 scrambled = owen_scrambled_sobol(key.x, SobolSeeds(key.y, key.z, key.w));
    const uint at = kOutputSize * i;
    outputs[at] = uintBitsToFloat(hash.x);
    outputs[at + 1u] = uintBitsToFloat(hash.y);
    outputs[at + 2u] = uintBitsToFloat(hash.z);
    outputs[at + 3u] = uintBitsToFloat(hash.w);
    outputs[at + 4u] = uintBitsToFloat(plain.x);
    outputs[at + 5u] = uintBitsToFloat(plain.y);
    outputs[at + 6u] = uintBitsToFloat(scrambled.x);
    outputs[at + 7u] = uintBitsToFloat(scrambled.y);
    outputs[at + 8u] = to_unit(key.x);
    const uint points = 1u + key.z % 1024u;
    outputs[at + 9u] = uniform_jittered(inputs[5u * i + 4u], key.y % points, points);
}
