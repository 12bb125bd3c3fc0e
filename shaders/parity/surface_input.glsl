// Points of surfaces among the inputs, with what the table says of them, and what samples of direct light return.
#include "parity/table_input.glsl"

const uint kSurfaceSize = 16u;

// A SurfacePoint<float> of C++.
SurfacePoint input_surface(uint begin) {
    return SurfacePoint(input_vec3(begin), input_vec3(begin + 3u), input_vec3(begin + 6u), input_vec3(begin + 9u),
                        input_vec3(begin + 12u), inputs[begin + 15u]);
}

SpecularFit fit_at(SurfacePoint point) {
    const ivec3 samples = ivec3(words[6], words[5], words[4]);
    const float cos_o = dot(point.normal, point.wo);
    const LtcTableCell cell = ltc_table_cell(point.roughness, cos_o, mean_f0(point.f0), samples);
    LtcTableEntry sum = LtcTableEntry(vec3(0.0), vec3(0.0));
    float of_black = 0.0;
    float of_white = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const ivec3 at = ltc_table_corner(cell, corner);
        const float weight = ltc_table_weight(cell, corner);
        ltc_table_add(sum, weight, sample_at(at, samples));
        of_black += weight * sample_at(ivec3(0, at.yz), samples).last.z;
        of_white += weight * sample_at(ivec3(samples.x - 1, at.yz), samples).last.z;
    }
    return fit_of(sum, of_black, of_white, point.f0);
}

// Direction and distance mean nothing where the sample does not count.
void write_sample(uint i, WorldLightSample s) {
    const uint at = kOutputSize * i;
    const bool counts = s.shadowed != vec3(0.0);
    write_vec3(at, counts ? s.direction : vec3(0.0));
    outputs[at + 3u] = counts ? s.distance : 0.0;
    write_vec3(at + 4u, s.shadowed);
    write_vec3(at + 7u, s.constant);
}
