#include "parity/table_input.glsl"

// Inputs: roughness, cosine of the inclination, f0, and a coloured f0.
void compute(uint i) {
    uint begin = 6u * i;
    ivec3 samples = ivec3(word_at(6u), word_at(5u), word_at(4u));
    LtcTableCell cell = ltc_table_cell(input_at(begin), input_at(begin + 1u), input_at(begin + 2u), samples);
    TableSums sums = table_sums(cell, samples);
    LtcCoefficients lobe = ltc_table_coefficients(sums.entry);
    float width = lobe.m22 - lobe.m20;
    results[0] = lobe.m00;
    results[1] = lobe.m02;
    results[2] = 1.0 / lobe.m11;
    results[3] = lobe.m20 / width;
    results[4] = width;
    results[5] = lobe.albedo;
    write_vec3(6, ltc_table_albedo(sums.of_black, sums.of_white, input_vec3(begin + 3u)));
}
