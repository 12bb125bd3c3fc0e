#ifndef NUSSELT_SAMPLING_CYLINDER_PROJECTED_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_CYLINDER_PROJECTED_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/cylinder_projected_solid_angle.h @ 9653ba74ebc5
/// Sampling of a closed cylinder of finite radius in proportion to the cosine at the surface, without rejection. With a
/// Lambertian tube on a Lambertian surface, almost all noise that remains comes from shadows. Twin of
/// include/nusselt/sampling/cylinder_projected_solid_angle.h.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]. It is wi.z times a factor that varies little
/// with the azimuth around the axis: the inner integral is exact, the outer one interpolated. wi.z / pdf is unbiased.
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself. Edge cases: no
/// part above the horizon, no length or radius, or origin inside: pdf = 0, measure 0.

#include "../core/light_sample.glsl"
#include "../sampling/cylinder_fan.glsl"

struct CylinderProjectedSolidAngle {
    CylinderFan fan; ///< scaled to an extent of order one
    float inverse_scale;
};

/// \param light in shading space [m].
CylinderProjectedSolidAngle cylinder_projected_solid_angle_prepare(const Cylinder light) {
    float scale = scale_of(light);
    return CylinderProjectedSolidAngle(
        make_cylinder_fan(kNusseltCosineImportance, scaled(light, scale), shading_space()),
        reciprocal_power_of_two(scale));
}

/// Estimate of the projected solid angle of the part of the light above the horizon [sr]: good enough for weights of
/// multiple importance sampling, not for shading.
float cylinder_projected_solid_angle_measure(const CylinderProjectedSolidAngle self) { return self.fan.integral; }

/// \param wi a unit direction towards the light.
float cylinder_projected_solid_angle_pdf(const CylinderProjectedSolidAngle self, vec3 wi) {
    return nusselt_max(wi.z, 0.0) * cylinder_fan_density_per_importance(self.fan, wi);
}

/// \param u in [0, 1)^2; u.x turns around the axis, increasing u.y moves along it. Continuous in both.
LightSample cylinder_projected_solid_angle_sample(const CylinderProjectedSolidAngle self, vec2 u) {
    vec3 p = cylinder_fan_point(self.fan, u);
    vec3 wi = self.fan.integral > 0.0 ? inverse_length(p) * p : vec3(0.0, 0.0, 1.0);
    wi.z = nusselt_max(wi.z, 0.0);
    return LightSample(wi, cylinder_projected_solid_angle_pdf(self, wi), self.inverse_scale * p);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 cylinder_projected_solid_angle_invert(const CylinderProjectedSolidAngle self, vec3 wi) {
    return cylinder_fan_invert(self.fan, wi, wi);
}

#endif
