#ifndef NUSSELT_GEOMETRY_CYLINDER_CAPS_GLSL
#define NUSSELT_GEOMETRY_CYLINDER_CAPS_GLSL
// Follows include/nusselt/geometry/cylinder_caps.h @ bc9d62f1b474
/// Tells the caps of a cylinder from its lateral surface.

#include "../geometry/cylinder.glsl"

/// Whether a ray from the origin that meets a closed cylinder from outside meets a cap first: what an open tube, which emits
/// from its lateral surface only, does not fill with light.
/// \param wi of any length.
/// Next to the rim of a cap, rounding decides. False inside the slab between the planes of the caps.
bool meets_cap(const Cylinder cylinder, vec3 wi) {
    LineSegment axis = cylinder.axis;
    float l0 = dot(axis.p0, axis.s);
    float l1 = l0 + axis.len;
    bool before = l0 > 0.0;
    float along = dot(wi, axis.s);
    // The ray reaches the plane of the cap after l / along; all lengths here are those times |along|.
    vec3 from_centre = (before ? l0 : l1) * wi - along * (before ? axis.p0 : end_of(axis));
    bool ahead = (before && along > 0.0) || (l1 < 0.0 && along < 0.0);
    return ahead && nusselt_length(from_centre) < cylinder.radius * abs(along);
}

#endif
