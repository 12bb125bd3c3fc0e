// Inputs: an environment, two random numbers, and an LtcCoefficients<float> of C++.
#include "parity/emission/environment_input.glsl"
#include "parity/lobe_input.glsl"

void compute(uint i) {
    uint begin = (kEnvironmentSize + kLobeSize) * i;

    Technique technique =
        technique_prepare(input_map(begin), input_frame(begin), input_lobe(begin + kEnvironmentSize));
    TexturedSample s = technique_sample(technique, input_random(begin));
    write_environment(s, technique.cells, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                      technique_measure(technique));
}
