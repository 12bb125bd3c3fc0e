#ifndef NUSSELT_PASSES_LIGHTS_ONE_DIRECTION_SAMPLES_GLSL
#define NUSSELT_PASSES_LIGHTS_ONE_DIRECTION_SAMPLES_GLSL
/// Lights without extent, with one shadow ray each however many samples other lights take.

#include "passes/lights/distant.glsl"
#include "passes/lights/point.glsl"

void add_direction(inout Estimate estimate, const OneDirection light) {
    // The part of the frame with the first samples has it.
    if (!light.role.is_lit || frame.first_sample != 0u) return;
    estimate.sum = CompensatedSum(vec3(0.0), vec3(0.0));
    vec3 reflected = light.wi.z * reflection_eval(estimate.reflection, light.wi);
    add_sample(estimate, DirectLightSample(light.wi, light.p, reflected, vec3(0.0)));
    estimate.radiance += light.role.emission * estimate.sum.sum;
}

void add_points(inout Estimate estimate) {
    for (uint i = first_index(kPointKind); kHasAnyPoints && i < end_index(kPointKind); ++i)
        add_direction(estimate, local_point(estimate.surface, i));
}

void add_distants(inout Estimate estimate) {
    for (uint i = first_index(kDistantKind); kHasDistants && i < end_index(kDistantKind); ++i)
        add_direction(estimate, local_distant(estimate.surface, i));
}

#endif
