#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/ltc/table.glsl"
#include "parity/buffers.glsl"

layout(set = 0, binding = 2, std430) readonly buffer Table { uint words[]; }; // of the file with half floats

const ivec3 kSamples = ivec3(2, 64, 64);

// Inputs: roughness, cosine of the inclination and f0.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const LtcTableCell cell = ltc_table_cell(inputs[3u * i], inputs[3u * i + 1u], 0.0, kSamples);
    LtcTableEntry sum = LtcTableEntry(vec3(0.0), vec3(0.0));
    for (int corner = 0; corner < 8; corner += 2) {
        const ivec3 at = ltc_table_corner(cell, corner);
        const int word = 3 * (at.z * kSamples.y + at.y);
        const vec4 shape = vec4(unpackHalf2x16(words[word]), unpackHalf2x16(words[word + 1]));
        const LtcTableEntry entry =
            ltc_engine_table_entry(shape, unpackHalf2x16(words[word + 2]), inputs[3u * i + 2u]);
        ltc_table_add(sum, ltc_table_weight(cell, corner), entry);
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
}
