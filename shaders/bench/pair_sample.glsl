// Samples that take two random numbers.
LightSample sample_of(const Technique technique, inout uint state) {
    const float u = next_random(state);
    return technique_sample(technique, vec2(u, next_random(state)));
}
