#ifndef PAGE_TRIANGLES_GLSL
#define PAGE_TRIANGLES_GLSL
/// Triangles in a texture.

#include "nusselt/core/vec.glsl"

const int kRowBits = @row_bits@; ///< rows have 2^kRowBits texels

uniform highp sampler2D triangles;

vec4 texel(highp sampler2D data, int index) {
    return texelFetch(data, ivec2(index & ((1 << kRowBits) - 1), index >> kRowBits), 0);
}

/// A vertex of a triangle [m]. In w: the material for corner 0, for corner 1 the number of the light that the
/// triangle belongs to, or -1.
vec4 triangle_corner(int number, int corner) { return texel(triangles, 3 * number + corner); }

#endif
