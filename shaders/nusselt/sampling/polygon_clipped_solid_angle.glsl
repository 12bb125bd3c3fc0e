#ifndef NUSSELT_SAMPLING_POLYGON_CLIPPED_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_POLYGON_CLIPPED_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/polygon_solid_angle.h @ fb5edaa204db
/// Uniform sampling of the solid angle of the part of a convex polygon above the horizon (polygon_solid_angle.glsl).
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], a constant.
/// Space: shading space; the shading point is the origin, the normal +z.
/// Edge cases: no part above the horizon, no area, or origin in the plane of the polygon: pdf = 0, measure 0.

#include "../geometry/polygon_part.glsl"
#include "../sampling/polygon_solid_angle.glsl"

/// \param light in shading space, either winding [m].
PolygonSolidAngle polygon_clipped_solid_angle_prepare(const ConvexPolygon light) {
    PolygonPart part = part_above_horizon(light);
    // New vertices are rounded. Whether the plane contains the origin is a question to the whole light. How far away it is
    // goes by the vertices of the part: the errors of the terms of the solid angle then cancel.
    float distance = part.plane_distance == 0.0 ? 0.0 : plane_distance(part.polygon);
    return polygon_solid_angle_prepare_scaled(part.polygon, part.inverse_scale, distance);
}

/// \param u in [0, 1)^2, see polygon_solid_angle_sample().
LightSample polygon_clipped_solid_angle_sample(const PolygonSolidAngle self, vec2 u) {
    LightSample s = polygon_solid_angle_sample(self, u);
    // Above the horizon in spite of rounding.
    if (s.wi.z < 0.0) {
        s.wi.z = 0.0;
        s.wi = inverse_length(s.wi) * s.wi;
        s.p.z = nusselt_max(s.p.z, 0.0);
    }
    return s;
}

/// Constant on the light; the caller knows that wi hits it.
float polygon_clipped_solid_angle_pdf(const PolygonSolidAngle self, vec3 wi) {
    return polygon_solid_angle_pdf(self, wi);
}

/// The random numbers for which the sample is wi, a unit direction on the light; (0, 0) at vertex 0.
vec2 polygon_clipped_solid_angle_invert(const PolygonSolidAngle self, vec3 wi) {
    return polygon_solid_angle_invert(self, wi);
}

/// Solid angle of the part above the horizon [sr].
float polygon_clipped_solid_angle_measure(const PolygonSolidAngle self) { return polygon_solid_angle_measure(self); }

#endif
