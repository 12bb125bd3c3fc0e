#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/ltc/line_shading.glsl"
#include "parity/lobe_input.glsl"

// Inputs: both ends in shading space, a lobe, a unit normal and a radius.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (10u + kLobeSize) * i;
    const LineSegment light = make_line(input_vec3(begin), input_vec3(begin + 3u));
    const Ltc ltc = input_lobe(begin + 6u);
    const uint rest = begin + 6u + kLobeSize;
    const float radius = inputs[rest + 3u];
    const float integral = lobe_integral(light, ltc);
    const float caps = caps_integral(light, radius, ltc);
    const LineSegment image = to_cosine_space(scaled(light, scale_of(light)), ltc);
    const uint at = kOutputSize * i;
    outputs[at] = diffuse_integral(light);
    outputs[at + 1u] = integral;
    outputs[at + 2u] = clipped_lobe_integral(light, ltc);
    outputs[at + 3u] = tube_integral(integral, radius);
    outputs[at + 4u] = tube_integral(integral, radius, clipped_caps_integral(light, radius, ltc));
    outputs[at + 5u] = caps;
    outputs[at + 6u] = strip_integral(light, input_vec3(rest), radius, integral);
    outputs[at + 7u] = diffuse_caps_integral(light, radius);
    write_vec3(at + 8u, image.s);
    outputs[at + 11u] = image.len;
}
