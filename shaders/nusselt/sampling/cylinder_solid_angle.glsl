#ifndef NUSSELT_SAMPLING_CYLINDER_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_CYLINDER_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/cylinder_solid_angle.h @ fe27260f607f
/// Sampling of the solid angle of a closed cylinder of finite radius, without rejection: for surfaces and for volumes.
/// Twin of include/nusselt/sampling/cylinder_solid_angle.h.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]. It varies little with the azimuth around the
/// axis: the inner integral is exact, the outer one interpolated. 1 / pdf is unbiased. Space: any frame with the shading
/// point as origin; no normal is involved and nothing is clipped. Edge cases: no length or radius, or origin inside: pdf
/// = 0, measure 0.

#include "../core/light_sample.glsl"
#include "../sampling/cylinder_fan.glsl"

struct CylinderSolidAngle {
    CylinderFan fan; ///< scaled to an extent of order one
    float inverse_scale;
};

/// \param light relative to the shading point [m].
CylinderSolidAngle cylinder_solid_angle_prepare(const Cylinder light) {
    float scale = scale_of(light);
    return CylinderSolidAngle(make_cylinder_fan(kNusseltUniformImportance, scaled(light, scale), shading_space()),
                              reciprocal_power_of_two(scale));
}

/// Estimate of the solid angle of the light [sr]: good enough for weights of multiple importance sampling, not for
/// shading.
float cylinder_solid_angle_measure(const CylinderSolidAngle self) { return self.fan.integral; }

/// \param wi a unit direction towards the light.
float cylinder_solid_angle_pdf(const CylinderSolidAngle self, vec3 wi) {
    return cylinder_fan_density_per_importance(self.fan, wi);
}

/// \param u in [0, 1)^2; u.x turns around the axis, increasing u.y moves along it. Continuous in both.
LightSample cylinder_solid_angle_sample(const CylinderSolidAngle self, vec2 u) {
    vec3 p = cylinder_fan_point(self.fan, u);
    vec3 wi = self.fan.integral > 0.0 ? inverse_length(p) * p : vec3(0.0, 0.0, 1.0);
    return LightSample(wi, cylinder_solid_angle_pdf(self, wi), self.inverse_scale * p);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 cylinder_solid_angle_invert(const CylinderSolidAngle self, vec3 wi) {
    return cylinder_fan_invert(self.fan, wi, wi);
}

#endif
