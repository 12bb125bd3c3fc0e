#version 450
#extension GL_GOOGLE_include_directive : require
#include "nusselt/random/pcg.glsl"
#include "nusselt/random/sobol.glsl"
#include "nusselt/random/unit_interval.glsl"
#include "parity/buffers.glsl"

// Inputs: the bits of four words, a number in [0, 1).
void compute(uint i) {
    uvec4 key = uvec4(floatBitsToUint(input_at(5u * i)), floatBitsToUint(input_at(5u * i + 1u)),
                            floatBitsToUint(input_at(5u * i + 2u)), floatBitsToUint(input_at(5u * i + 3u)));
    uvec4 hash = pcg4d(key);
    uvec2 plain = sobol(key.x);
    uvec2 scrambled = owen_scrambled_sobol(key.x, SobolSeeds(key.y, key.z, key.w));
    results[0] = uintBitsToFloat(hash.x);
    results[1] = uintBitsToFloat(hash.y);
    results[2] = uintBitsToFloat(hash.z);
    results[3] = uintBitsToFloat(hash.w);
    results[4] = uintBitsToFloat(plain.x);
    results[5] = uintBitsToFloat(plain.y);
    results[6] = uintBitsToFloat(scrambled.x);
    results[7] = uintBitsToFloat(scrambled.y);
    results[8] = to_unit(key.x);
    uint points = 1u + key.z % 1024u;
    results[9] = uniform_jittered(input_at(5u * i + 4u), key.y % points, points);
}
