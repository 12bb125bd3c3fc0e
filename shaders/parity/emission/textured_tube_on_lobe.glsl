// Inputs: a Cylinder<float> of C++, the first word of its profile, two random numbers, and an LtcCoefficients<float> of C++.
#include "parity/cylinder_input.glsl"
#include "parity/emission/line_profile_input.glsl"
#include "parity/lobe_input.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (kCylinderSize + 3u + kLobeSize) * i;
    const uint random = begin + kCylinderSize + 1u;
    const Cylinder light = input_cylinder(begin);

    Technique technique = technique_prepare(light, uint(inputs[begin + kCylinderSize]), input_lobe(begin + kCylinderSize + 3u));
    const LightSample s = technique_sample(technique, vec2(inputs[random], inputs[random + 1u]));
    const float measure = technique_measure(technique);
    write_along(i, s.wi, s.pdf,
                AlongLine(0.0, place_along(light.axis, s.p), measure, technique_pdf(technique, s.wi),
                          technique_invert(technique, s.wi), measure));
}
