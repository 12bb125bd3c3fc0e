#ifndef NUSSELT_CONES_CONE_PROJECTED_SOLID_ANGLE_GLSL
#define NUSSELT_CONES_CONE_PROJECTED_SOLID_ANGLE_GLSL
// Follows include/nusselt/cones/cone_projected_solid_angle.h @ 87c97e7e9d05
/// Sampling of ellipses and ellipsoids (disks and spheres: disk_light(), sphere_light()) in proportion to the cosine
/// at the surface. Twin of include/nusselt/cones/cone_projected_solid_angle.h, which has the measure and the edge
/// cases.
///
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.

#include "../cones/cosine_cone.glsl"
#include "../cones/round_lights.glsl"
#include "../core/light_sample.glsl"

struct ConeProjectedSolidAngle {
    RoundLightView view;
    CosineCone cone;
};

ConeProjectedSolidAngle cone_projected_solid_angle_of(const RoundLightView view) {
    return ConeProjectedSolidAngle(view, make_cosine_cone(view.cone));
}
/// \param light in shading space [m].
ConeProjectedSolidAngle cone_projected_solid_angle_prepare(const Ellipse light) {
    return cone_projected_solid_angle_of(view_of(light));
}
ConeProjectedSolidAngle cone_projected_solid_angle_prepare(const Ellipsoid light) {
    return cone_projected_solid_angle_of(view_of(light));
}

/// Projected solid angle of the part of the light above the horizon, at most pi [sr].
float cone_projected_solid_angle_measure(const ConeProjectedSolidAngle self) {
    return nusselt_min(cosine_cone_measure(self.cone), kNusseltPi);
}

/// \param wi a unit direction towards the light.
float cone_projected_solid_angle_pdf(const ConeProjectedSolidAngle self, vec3 wi) {
    float density = nusselt_max(wi.z, 0.0) * cosine_cone_density_per_cosine(self.cone, wi);
    return is_finite(density) ? density : 0.0;
}

/// \param u in [0, 1)^2. Continuous in both for cones above the horizon and for those that it cuts.
LightSample cone_projected_solid_angle_sample(const ConeProjectedSolidAngle self, vec2 u) {
    ConeSample s = cosine_cone_sample(self.cone, u);
    vec3 wi = cosine_cone_measure(self.cone) > 0.0 ? s.wi : vec3(0.0, 0.0, 1.0);
    // The point is that of the disk, moved to the ray: close to a large light, directions are more accurate than
    // points.
    float distance = nusselt_max(dot(wi, round_light_point(self.view, s.disk, wi)), 0.0);
    return LightSample(wi, cone_projected_solid_angle_pdf(self, wi), (self.view.inverse_scale * distance) * wi);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 cone_projected_solid_angle_invert(const ConeProjectedSolidAngle self, vec3 wi) {
    return cosine_cone_invert(self.cone, wi);
}

#endif
