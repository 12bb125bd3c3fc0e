// Inputs: a ConvexPolygon<float, NUSSELT_MAX_VERTICES> of C++, and two random numbers.
#include "parity/outputs.glsl"
#include "parity/polygon_input.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (kPolygonSize + 2u) * i;
    const vec2 u = vec2(inputs[begin + kPolygonSize], inputs[begin + kPolygonSize + 1u]);

    Technique technique = technique_prepare(input_polygon(begin));
    const LightSample s = technique_sample(technique, u);
    write_outputs(i, s, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                  technique_measure(technique));
}
