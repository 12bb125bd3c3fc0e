#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/ltc/line_shading.glsl"
#include "parity/lobe_input.glsl"

// Inputs: both ends in shading space, a lobe, a unit normal and a radius.
void compute(uint i) {
    uint begin = (10u + kLobeSize) * i;
    LineSegment light = make_line(input_vec3(begin), input_vec3(begin + 3u));
    Ltc ltc = input_lobe(begin + 6u);
    uint rest = begin + 6u + kLobeSize;
    float radius = input_at(rest + 3u);
    float integral = lobe_integral(light, ltc);
    float caps = caps_integral(light, radius, ltc);
    LineSegment image = to_cosine_space(scaled(light, scale_of(light)), ltc);
    results[0] = diffuse_integral(light);
    results[1] = integral;
    results[2] = clipped_lobe_integral(light, ltc);
    results[3] = tube_integral(integral, radius);
    results[4] = tube_integral(integral, radius, clipped_caps_integral(light, radius, ltc));
    results[5] = caps;
    results[6] = strip_integral(light, input_vec3(rest), radius, integral);
    results[7] = diffuse_caps_integral(light, radius);
    write_vec3(8, image.s);
    results[11] = image.len;
}
