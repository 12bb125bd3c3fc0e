/// Shows two images beside each other, or their errors from the reference.

#include "nusselt/core/compatibility.glsl"

uniform highp sampler2D left_frames;
uniform highp sampler2D right_frames;
uniform highp sampler2D reference_frames;
uniform float left_count, right_count, reference_count; ///< of frames
uniform float wipe; ///< the left image ends at this x of gl_FragCoord
uniform float exposure;
uniform bool shows_error;

out vec4 colour;

vec3 mean_of(vec4 frames, float count) { return count > 0.0 ? frames.xyz / count : vec3(0.0); }

/// The transfer function of sRGB.
vec3 to_srgb(vec3 linear) {
    vec3 v = clamp(linear, 0.0, 1.0);
    return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, vec3(greaterThan(v, vec3(0.0031308))));
}

/// Black up to a relative error of a thousandth, then blue, magenta and orange, and white from 1 on.
vec3 error_colour(vec3 value, vec3 reference) {
    // References that a display shows as black count like the darkest grey.
    const float kDarkest = 0.005;
    float relative = dot(abs(value - reference), vec3(1.0)) / (dot(abs(reference), vec3(1.0)) + 3.0 * kDarkest);
    vec3 ramp[5] = vec3[5](vec3(0.0), vec3(0.1, 0.1, 0.6), vec3(0.75, 0.15, 0.6), vec3(1.0, 0.6, 0.1), vec3(1.0));
    float at = 4.0 * clamp(1.0 + log2(max(relative, 1e-6)) / log2(1000.0), 0.0, 1.0);
    int cell = min(int(at), 3);
    return mix(ramp[cell], ramp[cell + 1], at - float(cell));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 mean = gl_FragCoord.x < wipe ? mean_of(texelFetch(left_frames, pixel, 0), left_count)
                                      : mean_of(texelFetch(right_frames, pixel, 0), right_count);
    vec3 reference = mean_of(texelFetch(reference_frames, pixel, 0), reference_count);
    vec3 shown = shows_error ? error_colour(exposure * mean, exposure * reference) : to_srgb(exposure * mean);
    colour = vec4(shown, 1.0);
}
