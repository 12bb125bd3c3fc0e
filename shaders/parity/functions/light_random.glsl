#include "parity/buffers.glsl"

// Inputs: the bits of sampler, seed, pixel, sample, count of samples, light and pair.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint word[8];
    for (uint k = 0u; k < 8u; ++k) word[k] = floatBitsToUint(inputs[8u * i + k]);
    const int kind = int(word[0]);
    const vec2 of_light = light_random(kind, word[1], word[2], word[3], word[4], word[5], word[6], word[7]);
    const vec2 of_camera = camera_random(kind, word[1], word[2], word[3], word[4]);
    const uint at = kOutputSize * i;
    outputs[at] = of_light.x;
    outputs[at + 1u] = of_light.y;
    outputs[at + 2u] = of_camera.x;
    outputs[at + 3u] = of_camera.y;
}
