// Inputs: a LineSegment<float> of C++, the first word of its profile, a random number, and an LtcCoefficients<float> of C++.
#include "parity/emission/line_profile_input.glsl"
#include "parity/line_input.glsl"
#include "parity/lobe_input.glsl"

void compute(uint i) {
    uint begin = (kLineSize + 2u + kLobeSize) * i;
    LineSegment light = input_line(begin);

    Technique technique = technique_prepare(light, uint(input_at(begin + kLineSize)), input_lobe(begin + kLineSize + 2u));
    TexturedSample s = technique_sample(technique, input_at(begin + kLineSize + 1u));
    float off = nusselt_length(s.p - exact_fma(s.at.x * light.len, light.s, light.p0));
    write_along(s.wi, s.pdf,
                AlongLine(s.at.x, s.pdf > 0.0 ? off : 0.0, technique.cells.expected.y,
                          technique_pdf(technique, s.wi), vec2(technique_invert(technique, s.wi), 0.0),
                          technique_measure(technique)));
}
