// Inputs: a LineSegment<float> and an LtcCoefficients<float> of C++, and a random number.
#include "parity/line_input.glsl"
#include "parity/lobe_input.glsl"
#include "parity/outputs.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (kLineSize + kLobeSize + 1u) * i;
    const uint lobe = begin + kLineSize;

    Technique technique = technique_prepare(input_line(begin), input_lobe(lobe));
    const LightSample s = technique_sample(technique, inputs[lobe + kLobeSize]);
    write_outputs(i, s, technique_pdf(technique, s.wi), vec2(technique_invert(technique, s.wi), 0.0),
                  technique_measure(technique));
}
