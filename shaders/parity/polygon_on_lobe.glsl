// Inputs: a ConvexPolygon<float, LIGHT_VERTICES> and an LtcCoefficients<float> of C++, and two random numbers.
#include "parity/lobe_input.glsl"
#include "parity/outputs.glsl"
#include "parity/polygon_input.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (kPolygonSize + kLobeSize + 2u) * i;
    const uint lobe = begin + kPolygonSize;
    const uint random = lobe + kLobeSize;

    Technique technique = technique_prepare(input_polygon(begin), input_lobe(lobe));
    const LightSample s = technique_sample(technique, vec2(inputs[random], inputs[random + 1u]));
    write_outputs(i, s, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                  technique_measure(technique));
}
