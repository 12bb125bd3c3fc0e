#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: cells are looked up as if they began at the edges of texels, not at their centres.
#include "nusselt/line_emission/line_profile.glsl"

int shifted_cell_at(uint profile, float x) {
    return clamp(int(x * float(line_profile_cells(profile))), 0, line_profile_cells(profile) - 1);
}
#define line_profile_cell_at shifted_cell_at
#include "nusselt/line_emission/textured_line.glsl"

#define Technique TexturedLine
#define technique_prepare textured_line_prepare
#define technique_sample textured_line_sample
#define technique_pdf textured_line_pdf
#define technique_invert textured_line_invert
#define technique_measure textured_line_measure
#include "parity/emission/textured_line.glsl"
