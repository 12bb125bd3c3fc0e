// Columns of a lobe: the members of LtcCoefficients.

Ltc column_lobe(uint first, uint index, inout vec4 sum) {
    float c[6];
    NUSSELT_UNROLL for (uint k = 0u; k < 6u; ++k) {
        c[k] = column(first + k, index);
        sum.x += c[k];
    }
    return ltc_prepare(LtcCoefficients(c[0], c[1], c[2], c[3], c[4], c[5]));
}
