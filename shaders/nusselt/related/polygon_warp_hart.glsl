#ifndef NUSSELT_RELATED_POLYGON_WARP_HART_GLSL
#define NUSSELT_RELATED_POLYGON_WARP_HART_GLSL
// Follows include/nusselt/related/polygon_warp_hart.h @ cd18661a8d4c
/// A published method, to compare with: solid angle sampling of a polygon with random numbers that are warped to follow the
/// cosine at the surface.
///
/// D. Hart, M. Pharr, T. Müller, W. Lopes, M. McGuire, P. Shirley 2020, Practical Product Sampling by Fitting and
/// Composing Warps, CGF 39(4), doi:10.1111/cgf.14060, with a bilinear or a biquadratic density. Twin of
/// include/nusselt/related/polygon_warp_hart.h, which describes its failures. Use polygon_projected_solid_angle.glsl
/// instead.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]. Space: shading space. Nothing is clipped unless the
/// name says so. Edge cases: no area, or origin in the plane of the polygon: pdf = 0, measure 0. u.y = 0 where vertex 0 is
/// not above the horizon: pdf = 0.

#include "../related/hart_warps.glsl"
#include "../sampling/polygon_clipped_solid_angle.glsl"

/// The technique below: the solid angle of the light, or of its part above the horizon.
struct HartPolygonBase {
    PolygonSolidAngle technique;
    float lowest; ///< bound on z of directions: 0 above the horizon, else the lowest number
};

LightSample hart_polygon_base_sample(const HartPolygonBase self, vec2 x) {
    LightSample s = polygon_solid_angle_sample(self.technique, x);
    // Above the horizon in spite of rounding.
    if (s.wi.z < self.lowest) {
        s.wi.z = 0.0;
        s.wi = inverse_length(s.wi) * s.wi;
        s.p.z = nusselt_max(s.p.z, 0.0);
    }
    return s;
}

float hart_cosine(vec3 p) { return nusselt_max(nusselt_normalize(p).z, 0.0); }

/// Cosines at the surface, or 0 below the horizon, of the corners of the map from random numbers to directions.
FanCorners hart_corner_cosines(ConvexPolygon light) {
    return FanCorners(hart_cosine(light.vertex[0]), hart_cosine(light.vertex[1]),
                      hart_cosine(light.vertex[NUSSELT_MAX_VERTICES - 1]));
}

/// Of the clipped light, whose new vertices are on the horizon.
/// \param light before clipping.
FanCorners hart_clipped_corner_cosines(ConvexPolygon light) {
    FanCorners corners = hart_corner_cosines(light);
    if (light.vertex[0].z > 0.0) return corners;
    // The fan begins where the boundary goes below the horizon, if it does so between the last vertex and the first one; the
    // next vertex is then the one where it comes up again. Otherwise, the fan begins where it comes up, and the first
    // vertex above the horizon is next.
    corners.first = 0.0;
    if (light.vertex[NUSSELT_MAX_VERTICES - 1].z > 0.0) return corners;
    NUSSELT_UNROLL for (int j = NUSSELT_MAX_VERTICES - 2; j > 0; --j) {
        if (light.vertex[j].z > 0.0) corners.first = hart_cosine(light.vertex[j]);
    }
    return corners;
}

/// With a bilinear warp.
struct PolygonBilinearWarpHart {
    HartPolygonBase base;
    HartBilinearWarp warp;
};

/// \param light in shading space, either winding [m].
PolygonBilinearWarpHart polygon_bilinear_warp_hart_prepare(const ConvexPolygon light) {
    HartPolygonBase base = HartPolygonBase(polygon_solid_angle_prepare(light), -kNusseltLargest);
    return PolygonBilinearWarpHart(base, hart_bilinear_warp(hart_corner_cosines(light)));
}

/// Prepares the part of a light above the horizon.
/// \param light in shading space, either winding [m].
PolygonBilinearWarpHart polygon_clipped_bilinear_warp_hart_prepare(const ConvexPolygon light) {
    HartPolygonBase base = HartPolygonBase(polygon_clipped_solid_angle_prepare(light), 0.0);
    return PolygonBilinearWarpHart(base, hart_bilinear_warp(hart_clipped_corner_cosines(light)));
}

/// \param u in [0, 1)^2, see polygon_solid_angle_sample().
LightSample polygon_bilinear_warp_hart_sample(const PolygonBilinearWarpHart self, vec2 u) {
    vec2 x = hart_bilinear_warp_sample(self.warp, u);
    LightSample s = hart_polygon_base_sample(self.base, x);
    // The density of the base may be as large as any number.
    s.pdf = nusselt_min(hart_bilinear_warp_density(self.warp, x) * s.pdf, kNusseltLargest);
    return s;
}

/// \param wi a unit direction on the light.
float polygon_bilinear_warp_hart_pdf(const PolygonBilinearWarpHart self, vec3 wi) {
    float density = hart_bilinear_warp_density(self.warp, polygon_solid_angle_invert(self.base.technique, wi));
    return nusselt_min(density * polygon_solid_angle_pdf(self.base.technique, wi), kNusseltLargest);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 polygon_bilinear_warp_hart_invert(const PolygonBilinearWarpHart self, vec3 wi) {
    return hart_bilinear_warp_invert(self.warp, polygon_solid_angle_invert(self.base.technique, wi));
}

/// Solid angle of the light, or with clipping of its part above the horizon [sr].
float polygon_bilinear_warp_hart_measure(const PolygonBilinearWarpHart self) {
    return polygon_solid_angle_measure(self.base.technique);
}

/// With a biquadratic warp.
struct PolygonBiquadraticWarpHart {
    HartPolygonBase base;
    HartBiquadraticWarp warp;
};

/// \param corners cosines of the corners of the base.
PolygonBiquadraticWarpHart polygon_biquadratic_warp_hart_prepare_base(const HartPolygonBase base,
                                                                      const FanCorners corners) {
    // Random numbers do not reach one.
    float one = below_one(1.0);
    vec2 point[4] = vec2[4](vec2(0.0, 0.5), vec2(0.5, 0.5), vec2(one, 0.5), vec2(0.5, one));
    float at[4];
    for (int i = 0; i < 4; ++i) at[i] = nusselt_max(hart_polygon_base_sample(base, point[i]).wi.z, 0.0);
    return PolygonBiquadraticWarpHart(base, hart_biquadratic_warp(corners.apex, vec3(at[0], at[1], at[2]),
                                                                  vec3(corners.first, at[3], corners.last)));
}

/// \param light in shading space, either winding [m].
PolygonBiquadraticWarpHart polygon_biquadratic_warp_hart_prepare(const ConvexPolygon light) {
    HartPolygonBase base = HartPolygonBase(polygon_solid_angle_prepare(light), -kNusseltLargest);
    return polygon_biquadratic_warp_hart_prepare_base(base, hart_corner_cosines(light));
}

/// Prepares the part of a light above the horizon.
/// \param light in shading space, either winding [m].
PolygonBiquadraticWarpHart polygon_clipped_biquadratic_warp_hart_prepare(const ConvexPolygon light) {
    HartPolygonBase base = HartPolygonBase(polygon_clipped_solid_angle_prepare(light), 0.0);
    return polygon_biquadratic_warp_hart_prepare_base(base, hart_clipped_corner_cosines(light));
}

/// \param u in [0, 1)^2, see polygon_solid_angle_sample().
LightSample polygon_biquadratic_warp_hart_sample(const PolygonBiquadraticWarpHart self, vec2 u) {
    vec2 x = hart_biquadratic_warp_sample(self.warp, u);
    LightSample s = hart_polygon_base_sample(self.base, x);
    // The density of the base may be as large as any number.
    s.pdf = nusselt_min(hart_biquadratic_warp_density(self.warp, x) * s.pdf, kNusseltLargest);
    return s;
}

/// \param wi a unit direction on the light.
float polygon_biquadratic_warp_hart_pdf(const PolygonBiquadraticWarpHart self, vec3 wi) {
    float density = hart_biquadratic_warp_density(self.warp, polygon_solid_angle_invert(self.base.technique, wi));
    return nusselt_min(density * polygon_solid_angle_pdf(self.base.technique, wi), kNusseltLargest);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 polygon_biquadratic_warp_hart_invert(const PolygonBiquadraticWarpHart self, vec3 wi) {
    return hart_biquadratic_warp_invert(self.warp, polygon_solid_angle_invert(self.base.technique, wi));
}

/// Solid angle of the light, or with clipping of its part above the horizon [sr].
float polygon_biquadratic_warp_hart_measure(const PolygonBiquadraticWarpHart self) {
    return polygon_solid_angle_measure(self.base.technique);
}

#endif
