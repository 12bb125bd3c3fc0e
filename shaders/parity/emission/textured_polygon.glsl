// Inputs: a light with a texture, and two random numbers.
#include "parity/emission/textured_input.glsl"

void compute(uint i) {
    uint begin = kTexturedSize * i;
    TexturePlane plane = input_plane(begin);

    Technique technique = technique_prepare(plane, input_light(begin));
    TexturedSample s = technique_sample(technique, input_random(begin));
    write_textured(s, technique.cells, plane, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                   technique_measure(technique));
}
