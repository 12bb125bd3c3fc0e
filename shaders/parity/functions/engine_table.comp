#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/ltc/table.glsl"
#include "parity/words.glsl"

const ivec3 kSamples = ivec3(2, 64, 64);

// Inputs: roughness, cosine of the inclination and f0.
void compute(uint i) {
    LtcTableCell cell = ltc_table_cell(input_at(3u * i), input_at(3u * i + 1u), 0.0, kSamples);
    LtcTableEntry sum = LtcTableEntry(vec3(0.0), vec3(0.0));
    for (int corner = 0; corner < 8; corner += 2) {
        ivec3 at = ltc_table_corner(cell, corner);
        uint word = uint(3 * (at.z * kSamples.y + at.y));
        vec4 shape = vec4(unpackHalf2x16(word_at(word)), unpackHalf2x16(word_at(word + 1u)));
        LtcTableEntry entry =
            ltc_engine_table_entry(shape, unpackHalf2x16(word_at(word + 2u)), input_at(3u * i + 2u));
        ltc_table_add(sum, ltc_table_weight(cell, corner), entry);
    }
    LtcCoefficients lobe = ltc_table_coefficients(sum);
    float width = lobe.m22 - lobe.m20;
    results[0] = lobe.m00;
    results[1] = lobe.m02;
    results[2] = 1.0 / lobe.m11;
    results[3] = lobe.m20 / width;
    results[4] = width;
    results[5] = lobe.albedo;
}
