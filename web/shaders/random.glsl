#ifndef PAGE_RANDOM_GLSL
#define PAGE_RANDOM_GLSL
/// The random numbers of samples, those of the C++ renderer.

#include "nusselt/random/light_random.glsl"
#include "surface.glsl"

uniform int seed;
uniform int first_sample; ///< number of the first sample in this frame
uniform int sample_count; ///< per pixel and frame

/// \param index of the sample in this frame.
/// \param light number of the light.
/// \param pair  number of the pair of random numbers.
vec2 random_for_light(int index, int light, int pair) {
    ivec2 pixel = pixel_of_image();
    return light_random(@sampler@, uint(seed), uint(pixel.x), uint(pixel.y), uint(first_sample + index), 1u,
                        uint(light), uint(pair));
}

#endif
