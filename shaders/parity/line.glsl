// Inputs: a LineSegment<float> of C++, and a random number.
#include "parity/line_input.glsl"
#include "parity/outputs.glsl"

void compute(uint i) {
    uint begin = (kLineSize + 1u) * i;

    Technique technique = technique_prepare(input_line(begin));
    LightSample s = technique_sample(technique, input_at(begin + kLineSize));
    write_outputs(s, technique_pdf(technique, s.wi), vec2(technique_invert(technique, s.wi), 0.0),
                  technique_measure(technique));
}
