// Inputs: an Ellipsoid<float> of C++, and two random numbers.
#include "parity/ellipsoid_input.glsl"
#include "parity/outputs.glsl"

void compute(uint i) {
    uint begin = (kEllipsoidSize + 2u) * i;
    uint random = begin + kEllipsoidSize;

    Technique technique = technique_prepare(input_ellipsoid(begin));
    LightSample s = technique_sample(technique, vec2(input_at(random), input_at(random + 1u)));
    write_outputs(s, technique_pdf(technique, s.wi), technique_invert(technique, s.wi), technique_measure(technique));
}
