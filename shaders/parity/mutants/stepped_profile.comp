#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: in each cell, tubes have the radiance of its start.
#include "nusselt/line_emission/line_profile.glsl"

float stepped_below(uint profile, float x) {
    int k = line_profile_cell_at(profile, x);
    return line_profile_before(profile, k) + (x - line_profile_border(profile, k)) * line_profile_value(profile, k);
}
#define line_profile_below stepped_below
#include "nusselt/line_emission/textured_tube.glsl"

#define Technique TexturedTube
#define technique_prepare textured_tube_prepare
#define technique_sample textured_tube_sample
#define technique_pdf textured_tube_pdf
// Software devices compile in less time what has no queries.
#define technique_invert(technique, wi) vec2(0.0)
#define technique_measure textured_tube_measure
#include "parity/emission/textured_tube.glsl"
