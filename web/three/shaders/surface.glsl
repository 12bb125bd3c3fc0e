#ifndef PAGE_SURFACE_GLSL
#define PAGE_SURFACE_GLSL
/// A fragment of a three.js material as a shading point in world space, in place of the file of the live page. What is
/// not declared here comes from three.js: viewMatrix, cameraPosition, receiveShadow.

#include "nusselt/estimate/surface.glsl"
#include "triangles.glsl"

uniform float scene_radius; ///< of a sphere around all that casts shadows [m]
uniform bool has_shadows;

/// Shadow rays start off the surface by this share of the radius of the scene ...
const float kOffsetPerRadius = 1e-5;
/// ... plus this share of the largest coordinate and of the distance to the eye, which bounds rounding errors of
/// positions: those in view space, interpolated between vertices.
const float kOffsetPerCoordinate = 1e-6;
/// The smallest cosine between the normal and the direction to the eye.
const float kSmallestEyeCosine = 1e-3;

struct Surface {
    vec3 position; ///< [m]
    vec3 normal;   ///< unit, of the triangle, on the side of the eye
    float offset;  ///< how far along the normal shadow rays start [m]
    int light;     ///< -1: no light is a surface
    Frame shading; ///< with the normal of the material, and wo in the xz half-plane
    float cos_o;   ///< cosine between normal and direction to the eye
};

ivec2 pixel_of_image() { return ivec2(gl_FragCoord.xy); }

/// A direction in view space, in world space.
vec3 to_world(vec3 v) { return (vec4(v, 0.0) * viewMatrix).xyz; }

/// \param position, normal, wo as three.js has them, in view space.
Surface surface_of(vec3 position, vec3 normal, vec3 wo) {
    vec3 across = cross(dFdx(position), dFdy(position));
    // Triangles that are too small for derivatives take the normal of the material.
    vec3 plane_normal = dot(across, across) > 0.0 ? normalize(across) : normal;
    if (dot(plane_normal, wo) < 0.0) plane_normal = -plane_normal;

    Surface surface;
    surface.position = cameraPosition + to_world(position);
    surface.normal = to_world(plane_normal);
    float largest = largest_component(surface.position) + length(position);
    surface.offset = kOffsetPerRadius * scene_radius + kOffsetPerCoordinate * largest;
    surface.light = -1;
    vec3 n = nusselt_normalize(normal + max(kSmallestEyeCosine - dot(normal, wo), 0.0) * wo);
    surface.shading = shading_frame(to_world(n), to_world(wo));
    surface.cos_o = dot(n, wo);
    return surface;
}

bool traces_shadows() { return has_shadows && receiveShadow; }

#endif
