// Inputs: a light with a texture, two random numbers, and an LtcCoefficients<float> of C++.
#include "parity/lobe_input.glsl"
#include "parity/emission/textured_input.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (kTexturedSize + kLobeSize) * i;
    const TexturePlane plane = input_plane(begin);

    Technique technique = technique_prepare(plane, input_light(begin), input_lobe(begin + kTexturedSize));
    const TexturedSample s = technique_sample(technique, input_random(begin));
    write_textured(i, s, technique.cells, plane, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                   technique_measure(technique));
}
