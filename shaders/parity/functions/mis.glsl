#include "parity/buffers.glsl"

// Inputs: heuristic, technique of the sample, visibility, counts of samples, coefficients, densities, components, and a
// random number.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = 20u * i;
    const MisTechniques techniques =
        MisTechniques(float[2](inputs[begin + 3u], inputs[begin + 4u]),
                      vec3[2](input_vec3(begin + 5u), input_vec3(begin + 8u)));
    const MisSample at = MisSample(float[2](inputs[begin + 11u], inputs[begin + 12u]),
                                   vec3[2](input_vec3(begin + 13u), input_vec3(begin + 16u)));
    const MisEstimate estimate =
        mis_estimate(int(inputs[begin]), int(inputs[begin + 1u]), inputs[begin + 2u], techniques, at);
    const OneSampleChoice choice = one_sample_choice_prepare(techniques);
    const OneSampleDecision decision = one_sample_choice_decide(choice, inputs[begin + 19u]);
    const uint result = kOutputSize * i;
    write_vec3(result, estimate.shadowed);
    write_vec3(result + 3u, estimate.constant);
    outputs[result + 6u] = choice.probability[0];
    outputs[result + 7u] = choice.probability[1];
    // Continuous also where the decision changes.
    outputs[result + 8u] = float(decision.chosen) + decision.u;
    write_vec3(result + 9u, one_sample_choice_estimate(choice, at).shadowed);
}
