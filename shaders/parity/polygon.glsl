// Inputs: vertices, edges and normal of a ConvexPolygon<float, NUSSELT_MAX_VERTICES> of C++, and two random numbers.
#include "parity/outputs.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint bound = NUSSELT_MAX_VERTICES;
    const uint begin = (6u * bound + 5u) * i;
    vec3 vertices[NUSSELT_MAX_VERTICES];
    vec3 edges[NUSSELT_MAX_VERTICES];
    for (uint j = 0; j < bound; ++j) {
        vertices[j] = input_vec3(begin + 3u * j);
        edges[j] = input_vec3(begin + 3u * (bound + j));
    }
    const ConvexPolygon light = make_polygon(vertices, edges, input_vec3(begin + 6u * bound));
    const vec2 u = vec2(inputs[begin + 6u * bound + 3u], inputs[begin + 6u * bound + 4u]);

    Technique technique = technique_prepare(light);
    const LightSample s = technique_sample(technique, u);
    write_outputs(i, s, technique_pdf(technique, s.wi), technique_invert(technique, s.wi),
                  technique_measure(technique));
}
