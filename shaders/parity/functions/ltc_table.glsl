#include "parity/table_input.glsl"

// Inputs: roughness, cosine of the inclination, f0, and a coloured f0.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = 6u * i;
    const ivec3 samples = ivec3(words[6], words[5], words[4]);
    const LtcTableCell cell = ltc_table_cell(inputs[begin], inputs[begin + 1u], inputs[begin + 2u], samples);
    const TableSums sums = table_sums(cell, samples);
    const LtcCoefficients lobe = ltc_table_coefficients(sums.entry);
    const float width = lobe.m22 - lobe.m20;
    const uint at = kOutputSize * i;
    outputs[at] = lobe.m00;
    outputs[at + 1u] = lobe.m02;
    outputs[at + 2u] = 1.0 / lobe.m11;
    outputs[at + 3u] = lobe.m20 / width;
    outputs[at + 4u] = width;
    outputs[at + 5u] = lobe.albedo;
    write_vec3(at + 6u, ltc_table_albedo(sums.of_black, sums.of_white, input_vec3(begin + 3u)));
}
