#ifndef NUSSELT_LINE_EMISSION_TEXTURED_TUBE_LTC_GLSL
#define NUSSELT_LINE_EMISSION_TEXTURED_TUBE_LTC_GLSL
// Follows include/nusselt/line_emission/textured_tube.h @ 9b9a07092402
/// Sampling of tubes of finite radius whose radiance varies along them, nearly in proportion to radiance times a glossy lobe. Twin
/// of TexturedTubeLtc in include/nusselt/line_emission/textured_tube.h.
///
/// Measure, space and edge cases are those of CylinderLtc.

#include "../line_emission/tube_warp.glsl"
#include "../sampling/cylinder_ltc.glsl"

struct TexturedTubeLtc {
    // The fields of a CylinderLtc, because WebGL forbids structures that are nested more than four deep.
    Ltc ltc;
    CylinderFan fan;
    float inverse_scale;
    TubeWarp along; ///< density of the second random number
};

CylinderLtc textured_tube_ltc_technique(const TexturedTubeLtc self) {
    return CylinderLtc(self.ltc, self.fan, self.inverse_scale);
}

/// \param light   in shading space [m].
/// \param profile number of its first word (line_profile.glsl).
TexturedTubeLtc textured_tube_ltc_prepare(const Cylinder light, uint profile, const Ltc ltc) {
    CylinderLtc technique = cylinder_ltc_prepare(light, ltc);
    return TexturedTubeLtc(technique.ltc, technique.fan, technique.inverse_scale,
                           tube_warp_prepare(technique.fan, technique.inverse_scale, light.axis, profile));
}

/// The measure of the technique times the radiance that it leads to, over the mean of the profile: good enough for weights of
/// multiple importance sampling.
float textured_tube_ltc_measure(const TexturedTubeLtc self) {
    return cylinder_ltc_measure(textured_tube_ltc_technique(self)) * tube_warp_integral(self.along);
}

/// \param u in [0, 1)^2; u.x turns around the axis, increasing u.y moves along it.
LightSample textured_tube_ltc_sample(const TexturedTubeLtc self, vec2 u) {
    float y = below_one(tube_warp_invert(self.along, u.y));
    LightSample s = cylinder_ltc_sample(textured_tube_ltc_technique(self), vec2(u.x, y));
    s.pdf = tube_warp_density_of_sample(self.along, s.pdf, y);
    return s;
}

/// \param wi a unit direction towards the light.
float textured_tube_ltc_pdf(const TexturedTubeLtc self, vec3 wi) {
    return tube_warp_density_of_sample(self.along, cylinder_ltc_pdf(textured_tube_ltc_technique(self), wi),
                                       cylinder_ltc_invert(textured_tube_ltc_technique(self), wi).y);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 textured_tube_ltc_invert(const TexturedTubeLtc self, vec3 wi) {
    vec2 u = cylinder_ltc_invert(textured_tube_ltc_technique(self), wi);
    float whole = tube_warp_integral(self.along);
    return vec2(u.x, whole > 0.0 ? below_one(tube_warp_below(self.along, u.y) / whole) : 0.0);
}

#endif
