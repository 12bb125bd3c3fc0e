#ifndef NUSSELT_EMISSION_TEXTURED_SAMPLE_GLSL
#define NUSSELT_EMISSION_TEXTURED_SAMPLE_GLSL
// Follows include/nusselt/emission/texture.h @ 64d980c45558
/// Samples on lights with a texture. Twin of what samplers need of include/nusselt/emission/texture.h.

#include "../core/light_sample.glsl"

/// A sample on a light with a texture.
struct TexturedSample {
    vec3 wi;   ///< unit direction from the shading point to the light
    float pdf; ///< density of wi; positive and finite, or exactly 0: no sample, the rest is then meaningless
    vec3 p;    ///< the point on the light [m], relative to the shading point
    vec2 at;   ///< texture coordinates of p: look up the radiance there
};

TexturedSample no_textured_sample() {
    const vec3 up = vec3(0.0, 0.0, 1.0);
    return TexturedSample(up, 0.0, up, vec2(0.0));
}

/// The scalar that probabilities go with.
float mean_of_channels(vec3 radiance) { return (radiance.x + radiance.y + radiance.z) / 3.0; }

#endif
