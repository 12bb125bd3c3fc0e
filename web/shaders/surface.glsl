#ifndef PAGE_SURFACE_GLSL
#define PAGE_SURFACE_GLSL
/// What the camera sees in a pixel, as a shading point.

#include "nusselt/estimate/surface.glsl"
#include "scene.glsl"

uniform highp isampler2D visible_numbers;
uniform float scene_radius; ///< of a sphere around the scene [m]
uniform bool has_shadows;

// The ray through a place on the film, which is measured in pixels from the upper left corner: eye + t (ray_corner +
// x ray_right + y ray_down).
uniform vec3 eye;
uniform vec3 ray_corner, ray_right, ray_down;
uniform vec2 place_in_pixel; ///< where rays pass all pixels, in [0, 1)^2
uniform float image_height;

/// Shadow rays start off the surface by this share of the radius of the scene ...
const float kOffsetPerRadius = 1e-5;
/// ... plus this share of the largest coordinate, which bounds rounding errors of positions.
const float kOffsetPerCoordinate = 1e-6;
/// The smallest cosine between the normal and the direction to the eye.
const float kSmallestEyeCosine = 1e-3;

struct Surface {
    Material material;
    bool is_front;
    vec3 position; ///< [m]
    vec3 normal;   ///< unit, on the side of the eye
    float offset;  ///< how far along the normal shadow rays start [m]
    int light;     ///< the number of the light that the surface belongs to, -1 for none
    Frame shading; ///< with wo in the xz half-plane
    float cos_o;   ///< cosine between normal and direction to the eye
};

/// The pixel, with row 0 at the top as in images.
ivec2 pixel_of_image() { return ivec2(int(gl_FragCoord.x), int(image_height) - 1 - int(gl_FragCoord.y)); }

Surface surface_at(int number) {
    vec2 place = vec2(pixel_of_image()) + place_in_pixel;
    vec3 ray = ray_corner + place.x * ray_right + place.y * ray_down;
    vec4 a = triangle_corner(number, 0);
    vec4 b = triangle_corner(number, 1);
    vec3 plane_normal = nusselt_normalize(cross(b.xyz - a.xyz, triangle_corner(number, 2).xyz - a.xyz));
    vec3 wo = -nusselt_normalize(ray);

    Surface surface;
    surface.material = material_of(int(a.w));
    surface.light = int(b.w);
    surface.position = eye + (dot(a.xyz - eye, plane_normal) / dot(ray, plane_normal)) * ray;
    surface.is_front = dot(plane_normal, wo) > 0.0;
    surface.normal = surface.is_front ? plane_normal : -plane_normal;
    surface.offset = kOffsetPerRadius * scene_radius + kOffsetPerCoordinate * largest_component(surface.position);
    vec3 n = nusselt_normalize(surface.normal + max(kSmallestEyeCosine - dot(surface.normal, wo), 0.0) * wo);
    surface.shading = shading_frame(n, wo);
    surface.cos_o = dot(n, wo);
    return surface;
}

/// Whether shadow rays are traced.
bool traces_shadows() { return has_shadows; }

/// The radiance that the surface emits towards the camera.
vec3 emission_of(Surface surface) { return surface.is_front ? surface.material.emission : vec3(0.0); }

#endif
