// Inputs: a Cylinder<float> of C++, and two random numbers.
#include "parity/cylinder_input.glsl"
#include "parity/outputs.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (kCylinderSize + 2u) * i;
    const uint random = begin + kCylinderSize;

    Technique technique = technique_prepare(input_cylinder(begin));
    const LightSample s = technique_sample(technique, vec2(inputs[random], inputs[random + 1u]));
    write_outputs(i, s, technique_pdf(technique, s.wi), technique_invert(technique, s.wi), technique_measure(technique));
}
