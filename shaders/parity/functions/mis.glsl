#include "parity/buffers.glsl"

// Inputs: heuristic, technique of the sample, visibility, counts of samples, coefficients, densities, components, and a
// random number.
void compute(uint i) {
    uint begin = 20u * i;
    MisTechniques techniques =
        MisTechniques(float[2](input_at(begin + 3u), input_at(begin + 4u)),
                      vec3[2](input_vec3(begin + 5u), input_vec3(begin + 8u)));
    MisSample at = MisSample(float[2](input_at(begin + 11u), input_at(begin + 12u)),
                                   vec3[2](input_vec3(begin + 13u), input_vec3(begin + 16u)));
    MisEstimate estimate =
        mis_estimate(int(input_at(begin)), int(input_at(begin + 1u)), input_at(begin + 2u), techniques, at);
    OneSampleChoice choice = one_sample_choice_prepare(techniques);
    OneSampleDecision decision = one_sample_choice_decide(choice, input_at(begin + 19u));
    write_vec3(0, estimate.shadowed);
    write_vec3(3, estimate.constant);
    results[6] = choice.probability[0];
    results[7] = choice.probability[1];
    // Continuous also where the decision changes.
    results[8] = float(decision.chosen) + decision.u;
    write_vec3(9, one_sample_choice_estimate(choice, at).shadowed);
}
