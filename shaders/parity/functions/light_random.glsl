#include "parity/words.glsl"

// Inputs: the bits of sampler, seed, pixel, sample, count of samples, light and pair.
void compute(uint i) {
    uint word[8];
    for (uint k = 0u; k < 8u; ++k) word[k] = floatBitsToUint(input_at(8u * i + k));
    int kind = int(word[0]);
    uvec2 at_ranks = light_blue_noise_indices(word[1], word[2], word[3], word[6], word[7]);
    uvec2 ranks = uvec2(blue_noise_rank(word_at(at_ranks.x / 2u), at_ranks.x),
                              blue_noise_rank(word_at(at_ranks.y / 2u), at_ranks.y));
    vec2 of_light = light_random(kind, word[1], word[2], word[3], word[4], word[5], word[6], word[7], ranks);
    vec2 of_camera = camera_random(kind, word[1], word[2], word[3], word[4]);
    results[0] = of_light.x;
    results[1] = of_light.y;
    results[2] = of_camera.x;
    results[3] = of_camera.y;
}
