#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: samples find their texel as if all of the cell were seen alike.
#include "nusselt/emission/cell_descent.glsl"

TexelChoice choose_flat(uint light, const TexturePlane plane, ivec2 cell, vec2 u) {
    vec3 up = vec3(0.0, 0.0, 1.0);
    return choose_texel(light, TexturePlane(up, vec3(0.0), vec3(0.0), up), cell, u);
}
#define choose_texel choose_flat
#include "nusselt/emission/textured_polygon.glsl"

#define Technique TexturedPolygon
#define technique_prepare textured_polygon_prepare
#define technique_sample textured_polygon_sample
// Software devices compile in less time what has no queries.
#define technique_pdf(technique, wi) 0.0
#define technique_invert(technique, wi) vec2(0.0)
#define technique_measure textured_polygon_measure
#include "parity/emission/textured_polygon.glsl"
