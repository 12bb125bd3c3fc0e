// Inputs: a Cylinder<float> of C++, the first word of its profile, two random numbers.
#include "parity/cylinder_input.glsl"
#include "parity/emission/line_profile_input.glsl"

void compute(uint i) {
    uint begin = (kCylinderSize + 3u) * i;
    uint random = begin + kCylinderSize + 1u;
    Cylinder light = input_cylinder(begin);

    Technique technique = technique_prepare(light, uint(input_at(begin + kCylinderSize)));
    LightSample s = technique_sample(technique, vec2(input_at(random), input_at(random + 1u)));
    float measure = technique_measure(technique);
    write_along(s.wi, s.pdf,
                AlongLine(0.0, place_along(light.axis, s.p), measure, technique_pdf(technique, s.wi),
                          technique_invert(technique, s.wi), measure));
}
