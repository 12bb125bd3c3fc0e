#ifndef PAGE_SCENE_GLSL
#define PAGE_SCENE_GLSL
/// Triangles and materials in textures.

#include "nusselt/core/vec.glsl"

const int kRowBits = 10; ///< rows have 2^10 texels

uniform highp sampler2D triangles;
uniform highp sampler2D materials;

vec4 texel(highp sampler2D data, int index) {
    return texelFetch(data, ivec2(index & ((1 << kRowBits) - 1), index >> kRowBits), 0);
}

/// A vertex of a triangle [m]. In w: the material for corner 0, for corner 1 the number of the light that the
/// triangle belongs to, or -1.
vec4 triangle_corner(int number, int corner) { return texel(triangles, 3 * number + corner); }

// Values of Material::model.
const float kLambert = 0.0;
const float kFrostbite = 1.0;
const float kNoSurface = 2.0; ///< visible because it emits, but reflects nothing and casts no shadow: a tube

struct Material {
    float model;
    vec3 diffuse;   ///< albedo
    vec3 f0;        ///< reflectance at normal incidence
    float roughness; ///< perceptual
    vec3 emission;  ///< radiance on the front side [W/(sr m^2)]
};

Material material_of(int index) {
    vec4 a = texel(materials, 3 * index);
    vec4 b = texel(materials, 3 * index + 1);
    vec4 c = texel(materials, 3 * index + 2);
    return Material(a.w, a.xyz, b.xyz, b.w, c.xyz);
}

#endif
