// Inputs: a light with a texture, two random numbers, and an LtcCoefficients<float> of C++.
#include "parity/lobe_input.glsl"
#include "parity/emission/textured_input.glsl"

void compute(uint i) {
    uint begin = (kTexturedSize + kLobeSize) * i;
    TexturePlane plane = input_plane(begin);

    Technique technique = technique_prepare(plane, input_light(begin), input_lobe(begin + kTexturedSize));
    TexturedSample s = technique_sample(technique, input_random(begin));
    write_textured(s, technique.cells, plane, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                   technique_measure(technique));
}
