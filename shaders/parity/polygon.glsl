// Inputs: a ConvexPolygon<float, NUSSELT_MAX_VERTICES> of C++, and two random numbers.
#include "parity/outputs.glsl"
#include "parity/polygon_input.glsl"

void compute(uint i) {
    uint begin = (kPolygonSize + 2u) * i;
    vec2 u = vec2(input_at(begin + kPolygonSize), input_at(begin + kPolygonSize + 1u));

    Technique technique = technique_prepare(input_polygon(begin));
    LightSample s = technique_sample(technique, u);
    write_outputs(s, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                  technique_measure(technique));
}
