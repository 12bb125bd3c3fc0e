#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_TEXTURE_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_TEXTURE_GLSL
/// The images that polygonal lights emit, as in src/render_cpu/kernel/lights/polygon_light.h.

#include "nusselt/emission/texture_plane.glsl"
#include "passes/lights/emission_words.glsl"

layout(constant_id = kTexturedPolygonsConstant) const bool kHasTexturedPolygons = true;

layout(set = 0, binding = kPolygonTexturesBinding, std430) readonly buffer PolygonTextures {
    PolygonTextureRecord polygon_textures[];
};

/// In world space.
TexturePlane texture_plane(int number) {
    return TexturePlane(to_vec(polygon_textures[number].corner), to_vec(polygon_textures[number].side_x),
                        to_vec(polygon_textures[number].side_y), to_vec(polygon_textures[number].normal));
}

/// The texel in a column and row; beyond the edge, those at the edge go on.
vec3 polygon_texel(int number, ivec2 at) {
    ivec2 size = ivec2(polygon_textures[number].width, polygon_textures[number].height);
    ivec2 inside = clamp(at, ivec2(0), size - 1);
    return emission_texel(polygon_textures[number].first_texel, uint(inside.y) * uint(size.x) + uint(inside.x));
}

/// Radiance at texture coordinates in [0, 1], as BilinearFilter of C++ interpolates it [W/(sr m^2)].
vec3 texture_radiance(int number, vec2 at) {
    vec2 x = at * vec2(polygon_textures[number].width, polygon_textures[number].height) - 0.5;
    vec2 low = floor(x);
    vec2 share = x - low;
    ivec2 texel = ivec2(low);
    vec3 below = (1.0 - share.x) * polygon_texel(number, texel) + share.x * polygon_texel(number, texel + ivec2(1, 0));
    vec3 above =
        (1.0 - share.x) * polygon_texel(number, texel + ivec2(0, 1)) + share.x * polygon_texel(number, texel + 1);
    return (1.0 - share.y) * below + share.y * above;
}

/// Radiance where a ray meets the plane of the texture [W/(sr m^2)].
vec3 texture_radiance_along(int number, const Ray ray) {
    TexturePlane plane = texture_plane(number);
    plane.corner -= ray.origin;
    float distance = dot(plane.normal, plane.corner) / dot(plane.normal, ray.direction);
    return texture_radiance(number, texture_plane_coordinates(plane, distance * ray.direction));
}

#endif
