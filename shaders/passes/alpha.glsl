#ifndef NUSSELT_PASSES_ALPHA_GLSL
#define NUSSELT_PASSES_ALPHA_GLSL
/// What shadow rays ask about surfaces that are partly there.

#include "passes/texture.glsl"

/// \param barycentrics of the second and the third vertex
float alpha_at(uint triangle, vec2 barycentrics, uint instance) {
    return alpha_of(materials[triangles[triangle].material], interpolated_uv(triangle, barycentrics));
}

#endif
