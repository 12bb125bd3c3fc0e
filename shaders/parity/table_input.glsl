#ifndef PARITY_TABLE_INPUT_GLSL
#define PARITY_TABLE_INPUT_GLSL
// The table of lobes.
#include "parity/words.glsl"

const uint kHeaderWords = 10u;

LtcTableEntry sample_at(ivec3 corner, ivec3 samples) {
    int index = ltc_table_index(corner, samples);
    uint at = kHeaderWords + 5u * uint(index) / 2u;
    return ltc_table_entry(uvec3(word_at(at), word_at(at + 1u), word_at(at + 2u)), index);
}

// The values of the table in a cell: interpolated between its corners, and the albedos of a black and of a white f0.
struct TableSums {
    LtcTableEntry entry;
    float of_black, of_white;
};

TableSums table_sums(const LtcTableCell cell, ivec3 samples) {
    TableSums sums = TableSums(LtcTableEntry(vec3(0.0), vec3(0.0)), 0.0, 0.0);
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 at = ltc_table_corner(cell, corner);
        float weight = ltc_table_weight(cell, corner);
        ltc_table_add(sums.entry, weight, sample_at(at, samples));
        sums.of_black += weight * sample_at(ivec3(0, at.yz), samples).last.z;
        sums.of_white += weight * sample_at(ivec3(samples.x - 1, at.yz), samples).last.z;
    }
    return sums;
}

#endif
