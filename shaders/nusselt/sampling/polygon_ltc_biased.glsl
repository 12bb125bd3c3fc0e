#ifndef NUSSELT_SAMPLING_POLYGON_LTC_BIASED_GLSL
#define NUSSELT_SAMPLING_POLYGON_LTC_BIASED_GLSL
// Follows include/nusselt/sampling/polygon_ltc.h @ 59dd6565f4ca
/// The biased variant of polygon_ltc.glsl: the image of the light in cosine space is sampled without iteration. Samples
/// deviate from their density as those of polygon_projected_solid_angle_biased.glsl do; polygon_ltc_measure() and
/// polygon_ltc_pdf() do not. Twin of PolygonLtcBiased in include/nusselt/sampling/polygon_ltc.h.

#include "../sampling/polygon_ltc.glsl"
#include "../sampling/polygon_projected_solid_angle_biased.glsl"

/// \param light in shading space, either winding [m].
PolygonLtc polygon_ltc_biased_prepare(const ConvexPolygon light, const Ltc ltc) {
    PolygonPart part = whole_part(light);
    return polygon_ltc_prepare_image(
        part, ltc, polygon_projected_solid_angle_biased_prepare(to_cosine_space(part.polygon, ltc)).approximate);
}

/// \param self by polygon_ltc_biased_prepare().
/// \param u    in [0, 1)^2; as continuous as that of polygon_projected_solid_angle_biased_sample().
LightSample polygon_ltc_biased_sample(const PolygonLtc self, vec2 u) {
    PolygonProjectedSolidAngleBiased image = PolygonProjectedSolidAngleBiased(self.image);
    return polygon_ltc_sample_image(self, polygon_projected_solid_angle_biased_sample(image, u));
}

#endif
