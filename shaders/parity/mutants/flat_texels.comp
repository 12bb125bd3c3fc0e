#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: all texels of a table have the same solid angle.
#include "nusselt/emission/rectified_table.glsl"

float flat_jacobian(float p, float q) { return 1.0; }
#define rectified_jacobian flat_jacobian
#include "nusselt/emission/windowed_polygon.glsl"

#define Technique WindowedPolygon
#define technique_prepare windowed_polygon_prepare
#define technique_sample windowed_polygon_sample
// Software devices compile in less time what has no queries.
#define technique_pdf(technique, wi) 0.0
#define technique_invert(technique, wi) vec2(0.0)
#define technique_measure windowed_polygon_measure
#include "parity/emission/windowed_polygon.glsl"
