#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: it takes the nearest sample of f0.
#include "nusselt/ltc/table.glsl"

LtcTableCell seamed_cell(float roughness, float cos_o, float f0, ivec3 samples) {
    LtcTableCell cell = ltc_table_cell(roughness, cos_o, f0, samples);
    cell.fraction.x = floor(cell.fraction.x + 0.5);
    return cell;
}
#define ltc_table_cell seamed_cell
#include "parity/functions/ltc_table.glsl"
