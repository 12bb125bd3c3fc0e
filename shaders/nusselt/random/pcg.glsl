#ifndef NUSSELT_RANDOM_PCG_GLSL
#define NUSSELT_RANDOM_PCG_GLSL
// Follows include/nusselt/random/pcg.h @ 5b221654936e
/// Pseudorandom bits without state. Twin of include/nusselt/random/pcg.h; its generator with 64 bits of state has none.

#include "../core/compatibility.glsl"

/// Hash of four words, the pcg4d of M. Jarzynski, M. Olano 2020, Hash Functions for GPU Rendering, JCGT 9(3). A
/// bijection. The high bits of the result are the better ones, the highest bit of a key is the worst.
uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> 16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

#endif
