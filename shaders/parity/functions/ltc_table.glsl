#include "parity/table_input.glsl"

// Inputs: roughness, cosine of the inclination, f0, and a coloured f0.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = 6u * i;
    const ivec3 samples = ivec3(words[6], words[5], words[4]);
    const LtcTableCell cell = ltc_table_cell(inputs[begin], inputs[begin + 1u], inputs[begin + 2u], samples);
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
    const LtcCoefficients lobe = ltc_table_coefficients(sum);
    const float width = lobe.m22 - lobe.m20;
    const uint at = kOutputSize * i;
    outputs[at] = lobe.m00;
    outputs[at + 1u] = lobe.m02;
    outputs[at + 2u] = 1.0 / lobe.m11;
    outputs[at + 3u] = lobe.m20 / width;
    outputs[at + 4u] = width;
    outputs[at + 5u] = lobe.albedo;
    write_vec3(at + 6u, ltc_table_albedo(of_black, of_white, input_vec3(begin + 3u)));
}
