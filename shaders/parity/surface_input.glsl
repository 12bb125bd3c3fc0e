// Points of surfaces among the inputs, with what the table says of them, and what samples of direct light return.
#include "parity/table_input.glsl"

const uint kSurfaceSize = 16u;

// A SurfacePoint<float> of C++.
SurfacePoint input_surface(uint begin) {
    return SurfacePoint(input_vec3(begin), input_vec3(begin + 3u), input_vec3(begin + 6u), input_vec3(begin + 9u),
                        input_vec3(begin + 12u), input_at(begin + 15u));
}

SpecularFit fit_at(const SurfacePoint point) {
    ivec3 samples = ivec3(word_at(6u), word_at(5u), word_at(4u));
    float cos_o = dot(point.normal, point.wo);
    LtcTableCell cell = ltc_table_cell(point.roughness, cos_o, mean_f0(point.f0), samples);
    TableSums sums = table_sums(cell, samples);
    return fit_of(sums.entry, sums.of_black, sums.of_white, point.f0);
}

// Direction and distance mean nothing where the sample does not count.
void write_sample(const WorldLightSample s) {
    bool counts = s.shadowed != vec3(0.0);
    write_vec3(0, counts ? s.direction : vec3(0.0));
    results[3] = counts ? s.distance : 0.0;
    write_vec3(4, s.shadowed);
    write_vec3(7, s.constant);
}
