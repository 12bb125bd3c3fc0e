#ifndef NUSSELT_CONES_CONE_SHADING_GLSL
#define NUSSELT_CONES_CONE_SHADING_GLSL
// Follows include/nusselt/cones/cone_shading.h @ f4dd3ef4235b
/// Analytic, unshadowed shading with spheres, disks, ellipses and ellipsoids, with the horizon. Twin of
/// include/nusselt/cones/cone_shading.h.
///
/// Integrals of normalised lobes: times the albedo of the lobe and the radiance of the light they are radiance.

#include "../cones/cosine_cone.glsl"
#include "../cones/round_lights.glsl"

/// Integral of the clamped cosine over an elliptic cone [sr].
float projected_solid_angle(const EllipticCone cone) {
    if (is_above_horizon(cone)) return make_whole_cone(cone).measure;
    return make_cone_sweep(cone).measure;
}

/// Integral of the Lambertian lobe over the part of a light above the surface, in [0, 1].
/// \param light in shading space [m].
float round_diffuse_integral(const Ellipse light) {
    return nusselt_min((1.0 / kNusseltPi) * projected_solid_angle(view_of(light).cone), 1.0);
}
float round_diffuse_integral(const Ellipsoid light) {
    return nusselt_min((1.0 / kNusseltPi) * projected_solid_angle(view_of(light).cone), 1.0);
}

/// Integral of a lobe over a light, in [0, 1].
/// \param light in shading space with wo in the xz half-plane [m].
float round_lobe_integral(const Ellipse light, const Ltc ltc) {
    return nusselt_min((1.0 / kNusseltPi) * projected_solid_angle(view_of(light, ltc).cone), 1.0);
}
float round_lobe_integral(const Ellipsoid light, const Ltc ltc) {
    return nusselt_min((1.0 / kNusseltPi) * projected_solid_angle(view_of(light, ltc).cone), 1.0);
}

#endif
