// Inputs: a light whose radiance depends on the direction, a surface, two random numbers, and an LtcCoefficients<float> of
// C++.
#include "parity/lobe_input.glsl"
#include "parity/emission/windowed_input.glsl"

void compute(uint i) {
    uint begin = (kWindowedSize + kLobeSize) * i;
    WindowPlane plane = input_plane(begin);

    Technique technique = technique_prepare(plane, input_light(begin), input_lobe(begin + kWindowedSize));
    TexturedSample s = technique_sample(technique, input_random(begin));
    write_windowed(s, windowed_polygon_ltc_cells(technique), plane, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                   technique_measure(technique));
}
