#ifndef NUSSELT_CONES_CONE_CLIPPED_SOLID_ANGLE_GLSL
#define NUSSELT_CONES_CONE_CLIPPED_SOLID_ANGLE_GLSL
// Follows include/nusselt/cones/cone_clipped_solid_angle.h @ 1c56adc4dddd
/// Sampling of the solid angle of the part of ellipses and ellipsoids (disks and spheres: disk_light(), sphere_light())
/// above the surface. Twin of include/nusselt/cones/cone_clipped_solid_angle.h, which has the measure and the edge
/// cases.
///
/// Space: shading space; the shading point is the origin, the normal +z. wi.z is not negative.

#include "../cones/cone_solid_angle.glsl"
#include "../cones/solid_sweep.glsl"
#include "../cones/whole_cone.glsl"

struct ConeClippedSolidAngle {
    ConeSolidAngle whole;
    bool is_whole;
    SolidSweep sweep; ///< only where the horizon cuts the light
    float share;      ///< of the samples of the whole light that are above the horizon
};

ConeClippedSolidAngle cone_clipped_solid_angle_of(const RoundLightView view) {
    ConeClippedSolidAngle self;
    self.whole = cone_solid_angle_of(view);
    // A half-space below the horizon touches it as well.
    self.is_whole = is_above_horizon(view.cone) && view.cone.e3.z > 0.0;
    // The sweep is costly to prepare, and seldom needed.
    if (!self.is_whole) self.sweep = make_solid_sweep(view.cone);
    // From inside, the samples of the whole light fill the sphere from the zenith to the nadir.
    self.share = view.is_inside ? 0.5 : 1.0;
    return self;
}
/// \param light in shading space [m].
ConeClippedSolidAngle cone_clipped_solid_angle_prepare(const Ellipse light) {
    return cone_clipped_solid_angle_of(view_of(light));
}
ConeClippedSolidAngle cone_clipped_solid_angle_prepare(const Ellipsoid light) {
    return cone_clipped_solid_angle_of(view_of(light));
}

/// Estimate of the solid angle above the horizon [sr], at most 2 pi.
float cone_clipped_solid_angle_measure(const ConeClippedSolidAngle self) {
    return self.is_whole ? self.share * self.whole.measure : nusselt_min(self.sweep.measure, 2.0 * kNusseltPi);
}

/// \param wi a unit direction towards the light.
/// \return 0 below the horizon.
float cone_clipped_solid_angle_pdf(const ConeClippedSolidAngle self, vec3 wi) {
    float density = self.is_whole ? cone_solid_angle_pdf(self.whole, wi) / self.share
                                  : solid_sweep_density(self.sweep, wi);
    return is_finite(density) && wi.z >= 0.0 ? density : 0.0;
}

/// \param u in [0, 1)^2; u.x turns around the axis, or around a pole on the horizon that cuts the light, u.y leads
/// away.
LightSample cone_clipped_solid_angle_sample(const ConeClippedSolidAngle self, vec2 u) {
    if (self.is_whole) {
        LightSample s = cone_solid_angle_sample(self.whole, vec2(u.x, self.share * u.y));
        // Rounding must not lead below a horizon that the light touches.
        s.wi.z = nusselt_max(s.wi.z, 0.0);
        s.p.z = nusselt_max(s.p.z, 0.0);
        s.pdf = cone_clipped_solid_angle_pdf(self, s.wi);
        return s;
    }
    ConeSample s = solid_sweep_sample(self.sweep, u);
    vec3 wi = self.sweep.measure > 0.0 ? s.wi : vec3(0.0, 0.0, 1.0);
    RoundLightView view = self.whole.view;
    float distance = nusselt_max(dot(wi, round_light_point(view, s.disk, wi)), 0.0);
    return LightSample(wi, cone_clipped_solid_angle_pdf(self, wi), (view.inverse_scale * distance) * wi);
}

/// The random numbers for which the sample is wi, a unit direction on the light and above the horizon.
vec2 cone_clipped_solid_angle_invert(const ConeClippedSolidAngle self, vec3 wi) {
    if (!self.is_whole) return solid_sweep_invert(self.sweep, wi);
    vec2 u = cone_solid_angle_invert(self.whole, wi);
    return vec2(u.x, below_one(u.y / self.share));
}

#endif
