// Inputs: a LineSegment<float> and an LtcCoefficients<float> of C++, and a random number.
#include "parity/line_input.glsl"
#include "parity/lobe_input.glsl"
#include "parity/outputs.glsl"

void compute(uint i) {
    uint begin = (kLineSize + kLobeSize + 1u) * i;
    uint lobe = begin + kLineSize;

    Technique technique = technique_prepare(input_line(begin), input_lobe(lobe));
    LightSample s = technique_sample(technique, input_at(lobe + kLobeSize));
    write_outputs(s, technique_pdf(technique, s.wi), vec2(technique_invert(technique, s.wi), 0.0),
                  technique_measure(technique));
}
