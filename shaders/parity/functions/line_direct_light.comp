#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/estimate/sample_direct_light.glsl"
#include "parity/surface_input.glsl"

// Inputs: both ends, a surface, heuristic, visibility, technique of the sample, and two points of the unit square.
void compute(uint i) {
    uint begin = (6u + kSurfaceSize + 7u) * i;
    LineSegment light = make_line(input_vec3(begin), input_vec3(begin + 3u));
    SurfacePoint point = input_surface(begin + 6u);
    SpecularFit fit = fit_at(point);
    uint rest = begin + 6u + kSurfaceSize;
    int heuristic = int(input_at(rest));
    int drawn = int(input_at(rest + 2u));
    float u0 = input_at(rest + 3u);
    float u1 = input_at(rest + 5u);
    if (heuristic == kNusseltMisOneSample) {
        Frame frame = shading_frame(point.normal, point.wo);
        LineDirectLight techniques = line_direct_light_prepare(to_shading_space(light, point.position, frame),
                                                                     glossy_surface_at(point, fit));
        write_sample(to_world(frame, line_direct_light_sample_one(techniques, u0)));
    } else {
        write_sample(sample_direct_light(point, light, fit, heuristic, input_at(rest + 1u), u0, u1).of[drawn]);
    }
}
