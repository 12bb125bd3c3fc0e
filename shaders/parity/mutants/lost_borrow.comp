#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: differences of integers of 64 bits forget what their lower halves borrow.
#include "nusselt/emission/rectified_table.glsl"

uvec2 difference_of_halves(uvec2 a, uvec2 b) { return a - b; }
#define difference_of_pairs difference_of_halves
#include "nusselt/emission/windowed_polygon.glsl"

#define Technique WindowedPolygon
#define technique_prepare windowed_polygon_prepare
#define technique_sample windowed_polygon_sample
// Software devices compile in less time what has no queries.
#define technique_pdf(technique, wi) 0.0
#define technique_invert(technique, wi) vec2(0.0)
#define technique_measure windowed_polygon_measure
#include "parity/emission/windowed_polygon.glsl"
