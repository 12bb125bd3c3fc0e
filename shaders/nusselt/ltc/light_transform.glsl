#ifndef NUSSELT_LTC_LIGHT_TRANSFORM_GLSL
#define NUSSELT_LTC_LIGHT_TRANSFORM_GLSL
// Follows include/nusselt/ltc/light_transform.h @ dc19531769d6
/// Lights in the cosine space of a lobe. A linear map takes polygons to polygons and segments to segments, and the
/// integral of the lobe over the light to that of the clamped cosine over its image. Twin of
/// include/nusselt/ltc/light_transform.h.
///
/// Counts the part of a light that the lobe reaches. Lobes also reach below the surface, but seldom (Peters 2021,
/// polygonal lights, Sec. 4.1); part_above_horizon() leaves that out.

#include "../geometry/clip_line.glsl"
#include "../geometry/polygon_part.glsl"
#include "../ltc/ltc.glsl"

/// \param light in shading space, with coordinates of order one (with_unit_extent()).
ConvexPolygon to_cosine_space(ConvexPolygon light, const Ltc ltc) {
    ConvexPolygon image;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        image.vertex[j] = ltc_to_cosine(ltc, light.vertex[j]);
        image.edge[j] = ltc_to_cosine(ltc, light.edge[j]);
    }
    image.normal = nusselt_normalize(ltc_normal_to_cosine(ltc, light.normal));
    return image;
}

/// \param light in shading space, with coordinates of order one (scaled()).
LineSegment to_cosine_space(const LineSegment light, const Ltc ltc) {
    vec3 s = ltc_to_cosine(ltc, light.s);
    float stretch = nusselt_length(s);
    float inverse = 1.0 / (stretch > 0.0 ? stretch : 1.0);
    return LineSegment(ltc_to_cosine(ltc, light.p0), inverse * s, stretch * light.len);
}

/// dR / dR_c: how much thicker a thin tube is in shading space than its image (Peters 2021, linear lights, Eq. 5, the
/// reciprocal of the width factor of Heitz and Hill 2017, Linear-Light Shading with Linearly Transformed Cosines).
/// \param moment cross product of a point and the direction of the line in shading space, of any length.
/// \returns 0 for the zero vector.
float radius_ratio(vec3 moment, const Ltc ltc) {
    return nusselt_length(ltc_normal_to_cosine(ltc, nusselt_normalize(moment))) / ltc.minor;
}

/// The part of a line above the surface.
/// \param light in shading space, with coordinates of order one (scaled()).
LineSegment part_above_horizon(const LineSegment light) {
    CenteredLine part = clip_to_horizon(centered(light));
    vec3 start = part.sign_of_s > 0.0 ? part.near : exact_fma(part.len, part.inward, part.near);
    start.z = nusselt_max(start.z, 0.0);
    return LineSegment(start, light.s, part.len);
}

#endif
