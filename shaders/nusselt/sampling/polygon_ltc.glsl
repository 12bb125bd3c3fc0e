#ifndef NUSSELT_SAMPLING_POLYGON_LTC_GLSL
#define NUSSELT_SAMPLING_POLYGON_LTC_GLSL
// Follows include/nusselt/sampling/polygon_ltc.h @ 59dd6565f4ca
/// Sampling of a convex polygon proportional to a linearly transformed cosine. With a Lambertian emitter and a lobe
/// that fits the specular BRDF times cosine, the noise that remains comes from shadows and from the misfit.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672: Sec. 4.1.
/// Twin of include/nusselt/sampling/polygon_ltc.h, where the deviation stands.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], that of the lobe over the measure. Space:
/// shading space with wo in the xz half-plane (shading_frame()); clips by itself. Edge cases: nothing of the light in
/// the lobe, no area, or origin in the plane of the polygon: pdf = 0, measure 0. Samples may lie below the surface,
/// wi.z < 0: they count, with a contribution of zero. After polygon_clipped_ltc_prepare() none does.

#include "../geometry/polygon_hull.glsl"
#include "../ltc/light_transform.glsl"
#include "../sampling/polygon_projected_solid_angle.glsl"

struct PolygonLtc {
    Ltc ltc;
    PolygonProjectedSolidAngle image; ///< in cosine space
    // The part of the light that counts, in shading space and scaled to an extent of order one.
    PolygonHull hull;
    float lowest;        ///< bound on z: 0 above the surface, else the lowest number
    float inverse_minor; ///< takes the scale of ltc_to_shading() back
    float inverse_scale; ///< a power of two
    float measure;
    float inverse_measure; ///< 0 without light
};

/// \param part  the part of the light that counts.
/// \param image of that part in cosine space.
PolygonLtc polygon_ltc_prepare_image(const PolygonPart part, const Ltc ltc, const PolygonProjectedSolidAngle image) {
    PolygonLtc self;
    self.ltc = ltc;
    self.image = image;
    self.inverse_scale = part.inverse_scale;
    self.lowest = -kNusseltLargest;
    self.inverse_minor = 1.0 / ltc.minor;
    self.hull = hull_of(part.polygon, part.plane_distance);
    float in_lobe = polygon_projected_solid_angle_measure(self.image);
    bool lit = in_lobe > 0.0 && self.hull.distance != 0.0;
    self.measure = lit ? (1.0 / kNusseltPi) * in_lobe : 0.0;
    self.inverse_measure = lit ? 1.0 / self.measure : 0.0;
    return self;
}

/// \param part the part of the light that counts.
PolygonLtc polygon_ltc_prepare_part(const PolygonPart part, const Ltc ltc) {
    return polygon_ltc_prepare_image(part, ltc,
                                     polygon_projected_solid_angle_prepare(to_cosine_space(part.polygon, ltc)));
}

/// \param light in shading space, either winding [m].
PolygonLtc polygon_ltc_prepare(const ConvexPolygon light, const Ltc ltc) {
    return polygon_ltc_prepare_part(whole_part(light), ltc);
}

/// Prepares the part of a light above the surface: samples are never below it.
/// \param light of at most NUSSELT_MAX_VERTICES - 1 vertices, since it is clipped twice.
PolygonLtc polygon_clipped_ltc_prepare(const ConvexPolygon light, const Ltc ltc) {
    PolygonLtc self = polygon_ltc_prepare_part(part_above_horizon(light), ltc);
    self.lowest = 0.0;
    return self;
}

/// Integral of the lobe over the light, in [0, 1].
float polygon_ltc_measure(const PolygonLtc self) { return self.measure; }

/// \param wi a unit direction towards the light.
float polygon_ltc_pdf(const PolygonLtc self, vec3 wi) {
    float density = ltc_density(self.ltc, wi) * self.inverse_measure;
    return is_finite(density) ? density : 0.0;
}

/// \param sampled of the image, in cosine space.
LightSample polygon_ltc_sample_image(const PolygonLtc self, const LightSample sampled) {
    vec3 direction = ltc_to_shading(self.ltc, sampled.wi);
    direction.z = nusselt_max(direction.z, self.lowest);
    direction = nusselt_normalize(direction);
    bool dark = self.inverse_measure == 0.0;
    vec3 wi = dark ? vec3(0.0, 0.0, 1.0) : direction;
    vec3 p = polygon_hull_point_along(self.hull, wi);
    // From 2^-7 on, rounding of the direction moves the point by at most 128 roundings of its distance.
    bool apart = abs(self.hull.distance) > 0.0078125 * self.hull.farthest;
    bool reached = self.measure > kNusseltEpsilon;
    if (!(apart && reached)) {
        // A direction that is almost in the plane does not tell where it meets the light. The point on the image does.
        vec3 image_point = self.inverse_minor * ltc_to_shading(self.ltc, sampled.p);
        image_point.z = nusselt_max(image_point.z, self.lowest);
        vec3 on_light = polygon_hull_moved_to_plane(self.hull, image_point);
        // Next to the horizon of the lobe, rounding turns the direction away from the light: the less of the lobe reaches
        // the light, the more often. A direction may pass its point by 48 roundings of the farthest vertex over the squared
        // sine of its angle with the plane.
        vec3 beside = nusselt_cross(direction, on_light);
        float to_plane = dot(self.hull.normal, direction);
        float squared_sine = nusselt_min(to_plane * to_plane, self.hull.distance * self.hull.distance /
                                                                  nusselt_max(dot(on_light, on_light), kNusseltTiny));
        float largest = 48.0 * kNusseltEpsilon * self.hull.farthest;
        bool ahead = dot(direction, on_light) >= 0.0;
        bool close = squared_sine * squared_sine * dot(beside, beside) <= largest * largest;
        bool sound = (ahead && close) || (reached && apart);
        if (!(sound || dark)) wi = nusselt_normalize(on_light);
        if (!(sound && apart)) p = on_light;
    }
    return LightSample(wi, polygon_ltc_pdf(self, wi), self.inverse_scale * p);
}

/// \param u in [0, 1)^2; as continuous as that of polygon_projected_solid_angle_sample().
LightSample polygon_ltc_sample(const PolygonLtc self, vec2 u) {
    return polygon_ltc_sample_image(self, polygon_projected_solid_angle_sample(self.image, u));
}

/// The random numbers for which the sample is wi, a unit direction on the light. See
/// polygon_projected_solid_angle_invert().
vec2 polygon_ltc_invert(const PolygonLtc self, vec3 wi) {
    return polygon_projected_solid_angle_invert(self.image, nusselt_normalize(ltc_to_cosine(self.ltc, wi)));
}

#endif
