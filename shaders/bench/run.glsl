// Prepares and samples lights. Included after functions for the light: prepared(index, sum), which adds up all that it
// loads, so that nobody saves the loads of what a technique does not need, and sample_of(technique, state).

void main() {
    const uint thread = gl_GlobalInvocationID.x;
    uint state = thread;
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < kLightCount; ++i) {
        Technique technique = prepared((thread + i) % kLights, sum);
        for (uint k = 0u; k < kSampleCount; ++k) sum += summary(sample_of(technique, state));
    }
    sums[thread] = sum;
}
