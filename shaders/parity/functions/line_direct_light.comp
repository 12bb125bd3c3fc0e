#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/estimate/sample_direct_light.glsl"
#include "parity/surface_input.glsl"

// Inputs: both ends, a surface, heuristic, visibility, technique of the sample, and two points of the unit square.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (6u + kSurfaceSize + 7u) * i;
    const LineSegment light = make_line(input_vec3(begin), input_vec3(begin + 3u));
    const SurfacePoint point = input_surface(begin + 6u);
    const SpecularFit fit = fit_at(point);
    const uint rest = begin + 6u + kSurfaceSize;
    const int heuristic = int(inputs[rest]);
    const int drawn = int(inputs[rest + 2u]);
    const float u0 = inputs[rest + 3u];
    const float u1 = inputs[rest + 5u];
    if (heuristic == kNusseltMisOneSample) {
        const Frame frame = shading_frame(point.normal, point.wo);
        const LineDirectLight techniques = line_direct_light_prepare(to_shading_space(light, point.position, frame),
                                                                     glossy_surface_at(point, fit));
        write_sample(i, to_world(frame, line_direct_light_sample_one(techniques, u0)));
    } else {
        write_sample(i, sample_direct_light(point, light, fit, heuristic, inputs[rest + 1u], u0, u1).of[drawn]);
    }
}
