#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/estimate/sample_direct_light.glsl"
#include "parity/surface_input.glsl"

// Inputs: four corners, a surface, heuristic, visibility, technique of the sample, and two points of the unit square.
void compute(uint i) {
    uint begin = (12u + kSurfaceSize + 7u) * i;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(begin + 3u * j);
    ConvexPolygon light = make_polygon(corners, 4);
    SurfacePoint point = input_surface(begin + 12u);
    SpecularFit fit = fit_at(point);
    uint rest = begin + 12u + kSurfaceSize;
    int heuristic = int(input_at(rest));
    int drawn = int(input_at(rest + 2u));
    vec2 u0 = vec2(input_at(rest + 3u), input_at(rest + 4u));
    vec2 u1 = vec2(input_at(rest + 5u), input_at(rest + 6u));
    if (heuristic == kNusseltMisOneSample) {
        Frame frame = shading_frame(point.normal, point.wo);
        PolygonDirectLight techniques = polygon_direct_light_prepare(
            to_shading_space(light, point.position, frame), glossy_surface_at(point, fit));
        write_sample(to_world(frame, polygon_direct_light_sample_one(techniques, u0)));
    } else {
        write_sample(sample_direct_light(point, light, fit, heuristic, input_at(rest + 1u), u0, u1).of[drawn]);
    }
}
