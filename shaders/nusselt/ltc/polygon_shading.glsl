#ifndef NUSSELT_LTC_POLYGON_SHADING_GLSL
#define NUSSELT_LTC_POLYGON_SHADING_GLSL
// Follows include/nusselt/ltc/polygon_shading.h @ 8a2465655011
/// Analytic, unshadowed shading with polygonal lights: E. Heitz, J. Dupuy, S. Hill, D. Neubelt 2016, Real-Time
/// Polygonal-Light Shading with Linearly Transformed Cosines, doi:10.1145/2897824.2925895, with exact clipping. Twin of
/// include/nusselt/ltc/polygon_shading.h.
///
/// Integrals of normalised lobes: times the albedo of the lobe and the radiance of the light they are radiance.

#include "../ltc/light_transform.glsl"

/// Integral of the Lambertian lobe over the part of a polygon above the surface, in [0, 1].
/// \param light in shading space, either winding [m].
float diffuse_integral(const ConvexPolygon light) { return (1.0 / kNusseltPi) * projected_solid_angle(light); }

/// Integral of a lobe over a polygon, in [0, 1]; 0 if the polygon has no area.
/// \param light in shading space with wo in the xz half-plane, either winding [m]. Accuracy: a few rounding errors of 1
/// in absolute terms. polygon_ltc_measure() is the same number, accurate relative to itself, at a higher cost.
float lobe_integral(const ConvexPolygon light, const Ltc ltc) {
    return diffuse_integral(to_cosine_space(with_unit_extent(light), ltc));
}

/// The same over the part of the polygon above the surface.
/// \param light of at most NUSSELT_MAX_VERTICES - 1 vertices.
float clipped_lobe_integral(const ConvexPolygon light, const Ltc ltc) {
    return diffuse_integral(to_cosine_space(part_above_horizon(light).polygon, ltc));
}

#endif
