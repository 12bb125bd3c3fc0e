#ifndef NUSSELT_RELATED_CYLINDER_PROJECTED_REJECTION_GAMITO_GLSL
#define NUSSELT_RELATED_CYLINDER_PROJECTED_REJECTION_GAMITO_GLSL
// Follows include/nusselt/related/cylinder_rejection_gamito.h @ e84609d96010
/// A published method, to compare with: projected solid angle sampling of a rectangle around the silhouette of a cylinder.
///
/// M. N. Gamito 2016, Solid Angle Sampling of Disk and Cylinder Lights, CGF 35(4), doi:10.1111/cgf.12946, with the map of
/// polygon_projected_solid_angle.glsl. Use cylinder_projected_solid_angle.glsl instead: it misses nothing. Twin of
/// CylinderProjectedRejectionGamito in include/nusselt/related/cylinder_rejection_gamito.h. NUSSELT_MAX_VERTICES must be 4
/// at least.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], wi.z / measure.
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
/// Edge cases: no length or radius, origin inside, or nothing above the horizon: pdf = 0, measure 0.

#include "../related/cylinder_rejection_gamito.glsl"
#include "../sampling/polygon_projected_solid_angle.glsl"

struct CylinderProjectedRejectionGamito {
    PolygonProjectedSolidAngle rectangle; ///< of the cylinder with an extent of order one
    GamitoRayTarget target;
    float inverse_scale;
};

/// \param light in shading space [m].
CylinderProjectedRejectionGamito cylinder_projected_rejection_gamito_prepare(const Cylinder light) {
    float scale = scale_of(light);
    CylinderView view = make_cylinder_view(scaled(light, scale), vec3(0.0));
    return CylinderProjectedRejectionGamito(polygon_projected_solid_angle_prepare(gamito_rectangle_around(view)),
                                            make_gamito_ray_target(view), reciprocal_power_of_two(scale));
}

/// Projected solid angle of the part of the rectangle above the horizon [sr], which is larger than that of the light.
float cylinder_projected_rejection_gamito_measure(const CylinderProjectedRejectionGamito self) {
    return polygon_projected_solid_angle_measure(self.rectangle);
}

/// The density of directions in the rectangle, whether they hit the cylinder or not.
float cylinder_projected_rejection_gamito_pdf(const CylinderProjectedRejectionGamito self, vec3 wi) {
    return polygon_projected_solid_angle_pdf(self.rectangle, wi);
}

/// \param u in [0, 1)^2, of the rectangle.
/// \return pdf = 0 where the direction misses the cylinder: an estimate counts it as 0.
LightSample cylinder_projected_rejection_gamito_sample(const CylinderProjectedRejectionGamito self, vec2 u) {
    return gamito_sample(polygon_projected_solid_angle_sample(self.rectangle, u), self.target, self.inverse_scale);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 cylinder_projected_rejection_gamito_invert(const CylinderProjectedRejectionGamito self, vec3 wi) {
    return polygon_projected_solid_angle_invert(self.rectangle, wi);
}

#endif
