#ifndef NUSSELT_PASSES_ALPHA_GLSL
#define NUSSELT_PASSES_ALPHA_GLSL
/// The alpha of surfaces, for shadow rays.

#include "passes/texture.glsl"

/// \param barycentrics weights of the second and the third vertex
float alpha_at(uint triangle, vec2 barycentrics, uint instance) {
    return alpha_of(materials[triangles[triangle].material], interpolated_uv(triangle, barycentrics));
}

/// \param triangle one of a round light
float alpha_on_round(uint triangle, vec2 uv) { return alpha_of(materials[triangles[triangle].material], uv); }

#endif
