#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/geometry/clip_line.glsl"
#include "parity/buffers.glsl"

// Inputs: both ends in world space, the shading point and its unit normal.
void compute(uint i) {
    uint begin = 12u * i;
    Frame frame = frame_from_normal(input_vec3(begin + 9u));
    LineSegment light = to_shading_space(make_line(input_vec3(begin), input_vec3(begin + 3u)),
                                               input_vec3(begin + 6u), frame);
    results[0] = light.len;
    results[1] = solid_angle(light);
    results[2] = projected_solid_angle(light);
    write_vec3(3, light.p0);
    write_vec3(6, light.s);
}
