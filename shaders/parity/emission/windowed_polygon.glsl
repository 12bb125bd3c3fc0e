// Inputs: a light whose radiance depends on the direction, a surface, and two random numbers.
#include "parity/emission/windowed_input.glsl"

void compute(uint i) {
    uint begin = kWindowedSize * i;
    WindowPlane plane = input_plane(begin);

    Technique technique = technique_prepare(plane, input_light(begin));
    TexturedSample s = technique_sample(technique, input_random(begin));
    write_windowed(s, windowed_polygon_cells(technique), plane, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                   technique_measure(technique));
}
