// Inputs: a LineSegment<float> of C++, and a random number.
#include "parity/outputs.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = 8u * i;
    LineSegment light;
    light.p0 = input_vec3(begin);
    light.s = input_vec3(begin + 3u);
    light.len = inputs[begin + 6u];

    Technique technique = technique_prepare(light);
    const LightSample s = technique_sample(technique, inputs[begin + 7u]);
    write_outputs(i, s, technique_pdf(technique, s.wi), vec2(technique_invert(technique, s.wi), 0.0),
                  technique_measure(technique));
}
