// Inputs: an Ellipse<float> of C++, and two random numbers.
#include "parity/ellipse_input.glsl"
#include "parity/outputs.glsl"

void compute(uint i) {
    uint begin = (kEllipseSize + 2u) * i;
    uint random = begin + kEllipseSize;

    Technique technique = technique_prepare(input_ellipse(begin));
    LightSample s = technique_sample(technique, vec2(input_at(random), input_at(random + 1u)));
    write_outputs(s, technique_pdf(technique, s.wi), technique_invert(technique, s.wi), technique_measure(technique));
}
