// Inputs: a LineSegment<float> of C++, and a random number.
#include "parity/line_input.glsl"
#include "parity/outputs.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (kLineSize + 1u) * i;

    Technique technique = technique_prepare(input_line(begin));
    const LightSample s = technique_sample(technique, inputs[begin + kLineSize]);
    write_outputs(i, s, technique_pdf(technique, s.wi), vec2(technique_invert(technique, s.wi), 0.0),
                  technique_measure(technique));
}
