#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/estimate/sample_direct_light.glsl"
#include "parity/surface_input.glsl"

// Inputs: four corners, a surface, heuristic, visibility, technique of the sample, and two points of the unit square.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (12u + kSurfaceSize + 7u) * i;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(begin + 3u * j);
    const ConvexPolygon light = make_polygon(corners, 4);
    const SurfacePoint point = input_surface(begin + 12u);
    const SpecularFit fit = fit_at(point);
    const uint rest = begin + 12u + kSurfaceSize;
    const int heuristic = int(inputs[rest]);
    const int drawn = int(inputs[rest + 2u]);
    const vec2 u0 = vec2(inputs[rest + 3u], inputs[rest + 4u]);
    const vec2 u1 = vec2(inputs[rest + 5u], inputs[rest + 6u]);
    if (heuristic == kNusseltMisOneSample) {
        const Frame frame = shading_frame(point.normal, point.wo);
        const PolygonDirectLight techniques = polygon_direct_light_prepare(
            to_shading_space(light, point.position, frame), glossy_surface_at(point, fit));
        write_sample(i, to_world(frame, polygon_direct_light_sample_one(techniques, u0)));
    } else {
        write_sample(i, sample_direct_light(point, light, fit, heuristic, inputs[rest + 1u], u0, u1).of[drawn]);
    }
}
