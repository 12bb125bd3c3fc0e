// Points of surfaces among the inputs, with what the table says of them, and what samples of direct light return.
#include "parity/table_input.glsl"

const uint kSurfaceSize = 16u;

// A SurfacePoint<float> of C++.
SurfacePoint input_surface(uint begin) {
    return SurfacePoint(input_vec3(begin), input_vec3(begin + 3u), input_vec3(begin + 6u), input_vec3(begin + 9u),
                        input_vec3(begin + 12u), inputs[begin + 15u]);
}

SpecularFit fit_at(const SurfacePoint point) {
    const ivec3 samples = ivec3(words[6], words[5], words[4]);
    const float cos_o = dot(point.normal, point.wo);
    const LtcTableCell cell = ltc_table_cell(point.roughness, cos_o, mean_f0(point.f0), samples);
    const TableSums sums = table_sums(cell, samples);
    return fit_of(sums.entry, sums.of_black, sums.of_white, point.f0);
}

// Direction and distance mean nothing where the sample does not count.
void write_sample(uint i, const WorldLightSample s) {
    const uint at = kOutputSize * i;
    const bool counts = s.shadowed != vec3(0.0);
    write_vec3(at, counts ? s.direction : vec3(0.0));
    outputs[at + 3u] = counts ? s.distance : 0.0;
    write_vec3(at + 4u, s.shadowed);
    write_vec3(at + 7u, s.constant);
}
