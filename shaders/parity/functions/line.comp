#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/geometry/clip_line.glsl"
#include "parity/buffers.glsl"

// Inputs: both ends in world space, the shading point and its unit normal.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = 12u * i;
    const Frame frame = frame_from_normal(input_vec3(begin + 9u));
    const LineSegment light = to_shading_space(make_line(input_vec3(begin), input_vec3(begin + 3u)),
                                               input_vec3(begin + 6u), frame);
    const uint at = kOutputSize * i;
    outputs[at] = light.len;
    outputs[at + 1u] = solid_angle(light);
    outputs[at + 2u] = projected_solid_angle(light);
    write_vec3(at + 3u, light.p0);
    write_vec3(at + 6u, light.s);
}
