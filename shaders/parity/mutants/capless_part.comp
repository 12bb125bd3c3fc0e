#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: where the origin is beyond an end of a tube, nothing of its cap remains.
#include "nusselt/line_emission/visible_part.glsl"

LineSegment capless_part(const LineSegment axis, float radius, float slope) { return visible_part(axis, slope); }
#define visible_part_of_tube capless_part
#include "parity/functions/visible_part.glsl"
