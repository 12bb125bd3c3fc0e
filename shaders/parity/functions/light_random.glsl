#include "parity/buffers.glsl"

layout(set = 0, binding = 2, std430) readonly buffer BlueNoise { uint blue_noise[]; };

// Inputs: the bits of sampler, seed, pixel, sample, count of samples, light and pair.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint word[8];
    for (uint k = 0u; k < 8u; ++k) word[k] = floatBitsToUint(inputs[8u * i + k]);
    const int kind = int(word[0]);
    const uvec2 at_ranks = light_blue_noise_indices(word[1], word[2], word[3], word[6], word[7]);
    const uvec2 ranks = uvec2(blue_noise_rank(blue_noise[at_ranks.x / 2u], at_ranks.x),
                              blue_noise_rank(blue_noise[at_ranks.y / 2u], at_ranks.y));
    const vec2 of_light = light_random(kind, word[1], word[2], word[3], word[4], word[5], word[6], word[7], ranks);
    const vec2 of_camera = camera_random(kind, word[1], word[2], word[3], word[4]);
    const uint at = kOutputSize * i;
    outputs[at] = of_light.x;
    outputs[at + 1u] = of_light.y;
    outputs[at + 2u] = of_camera.x;
    outputs[at + 3u] = of_camera.y;
}
