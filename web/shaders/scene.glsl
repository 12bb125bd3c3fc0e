#ifndef PAGE_SCENE_GLSL
#define PAGE_SCENE_GLSL
/// Materials in a texture, beside triangles.

#include "triangles.glsl"

uniform highp sampler2D materials;

// Values of Material::model.
const float kLambert = @model_lambert@;
const float kFrostbite = @model_frostbite@;
/// Visible because it emits, but reflects nothing and casts no shadow: a tube.
const float kNoSurface = @model_no_surface@;

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
