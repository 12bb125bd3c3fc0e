#ifndef PARITY_TABLE_INPUT_GLSL
#define PARITY_TABLE_INPUT_GLSL
// The table of lobes.
#include "parity/buffers.glsl"

layout(set = 0, binding = 2, std430) readonly buffer Table { uint words[]; }; // of the file with numbers of 16 bits

const uint kHeaderWords = 10u;

LtcTableEntry sample_at(ivec3 corner, ivec3 samples) {
    const int index = ltc_table_index(corner, samples);
    const uint at = kHeaderWords + 5u * uint(index) / 2u;
    return ltc_table_entry(uvec3(words[at], words[at + 1u], words[at + 2u]), index);
}

#endif
