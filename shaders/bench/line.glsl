// Columns: begin, direction and length.
#include "bench/workload.glsl"

void main() {
    const uint thread = gl_GlobalInvocationID.x;
    uint state = thread;
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < kLightCount; ++i) {
        const uint index = (thread + i) % kLights;
        LineSegment light;
        light.p0 = column_vec3(0u, index);
        light.s = column_vec3(3u, index);
        light.len = column(6u, index);
        sum += vec4(light.p0 + light.s, light.len); // so that nobody saves the loads of what a technique does not need

        Technique technique = technique_prepare(light);
        for (uint k = 0u; k < kSampleCount; ++k) sum += summary(technique_sample(technique, next_random(state)));
    }
    sums[thread] = sum;
}
