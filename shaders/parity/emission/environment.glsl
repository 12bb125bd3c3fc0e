// Inputs: an environment, and two random numbers.
#include "parity/emission/environment_input.glsl"

void compute(uint i) {
    uint begin = kEnvironmentSize * i;

    Technique technique = technique_prepare(input_map(begin), input_frame(begin));
    TexturedSample s = technique_sample(technique, input_random(begin));
    write_environment(s, technique.cells, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                      technique_measure(technique));
}
