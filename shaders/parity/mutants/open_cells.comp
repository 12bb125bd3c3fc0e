#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: the outline does not close the cells that it cuts.
#include "nusselt/emission/textured_light.glsl"

int no_pieces(uint light) { return 0; }
#define textured_light_pieces no_pieces
#include "nusselt/emission/textured_polygon.glsl"

#define Technique TexturedPolygon
#define technique_prepare textured_polygon_prepare
#define technique_sample textured_polygon_sample
// Software devices compile in less time what has no queries.
#define technique_pdf(technique, wi) 0.0
#define technique_invert(technique, wi) vec2(0.0)
#define technique_measure textured_polygon_measure
#include "parity/emission/textured_polygon.glsl"
