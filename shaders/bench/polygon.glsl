// Columns: vertices, edges (the last one closes the polygon) and normal.
#include "bench/workload.glsl"

void main() {
    const uint thread = gl_GlobalInvocationID.x;
    uint state = thread;
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < kLightCount; ++i) {
        const uint index = (thread + i) % kLights;
        const uint bound = NUSSELT_MAX_VERTICES;
        vec3 vertices[NUSSELT_MAX_VERTICES];
        vec3 edges[NUSSELT_MAX_VERTICES];
        vec3 all = vec3(0.0); // so that nobody saves the loads of what a technique does not need
        NUSSELT_UNROLL for (uint j = 0u; j < bound; ++j) {
            vertices[j] = column_vec3(3u * j, index);
            edges[j] = column_vec3(3u * (bound + j), index);
            all += vertices[j] + edges[j];
        }
        const ConvexPolygon light = make_polygon(vertices, edges, column_vec3(6u * bound, index));
        sum.xyz += all + light.normal;

        Technique technique = technique_prepare(light);
        for (uint k = 0u; k < kSampleCount; ++k) {
            const float u = next_random(state);
            sum += summary(technique_sample(technique, vec2(u, next_random(state))));
        }
    }
    sums[thread] = sum;
}
