// Inputs: an Ellipsoid<float> and an LtcCoefficients<float> of C++, and two random numbers.
#include "parity/ellipsoid_input.glsl"
#include "parity/lobe_input.glsl"
#include "parity/outputs.glsl"

void compute(uint i) {
    uint begin = (kEllipsoidSize + kLobeSize + 2u) * i;
    uint lobe = begin + kEllipsoidSize;
    uint random = lobe + kLobeSize;

    Technique technique = technique_prepare(input_ellipsoid(begin), input_lobe(lobe));
    LightSample s = technique_sample(technique, vec2(input_at(random), input_at(random + 1u)));
    write_outputs(s, technique_pdf(technique, s.wi), technique_invert(technique, s.wi), technique_measure(technique));
}
