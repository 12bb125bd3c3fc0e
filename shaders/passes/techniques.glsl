#ifndef NUSSELT_PASSES_TECHNIQUES_GLSL
#define NUSSELT_PASSES_TECHNIQUES_GLSL
/// The techniques of the settings for each kind of light: number 0 for the diffuse component or for all, number 1 for the
/// specular one. Structs stand for unions: of their members, those of the techniques in use are set, and the driver removes
/// the others.

#include "nusselt/sampling/cylinder_area.glsl"
#include "nusselt/sampling/cylinder_ltc.glsl"
#include "nusselt/sampling/cylinder_projected_solid_angle.glsl"
#include "nusselt/sampling/cylinder_solid_angle.glsl"
#include "nusselt/sampling/line_area.glsl"
#include "nusselt/sampling/line_ltc.glsl"
#include "nusselt/sampling/line_projected_solid_angle.glsl"
#include "nusselt/sampling/line_solid_angle.glsl"
#include "nusselt/sampling/polygon_area.glsl"
#include "nusselt/sampling/polygon_brdf.glsl"
#include "nusselt/sampling/polygon_clipped_solid_angle.glsl"
#include "nusselt/sampling/polygon_ltc.glsl"
#include "nusselt/sampling/polygon_ltc_biased.glsl"
#include "nusselt/sampling/polygon_projected_solid_angle.glsl"
#include "nusselt/sampling/polygon_projected_solid_angle_biased.glsl"
#include "nusselt/sampling/polygon_solid_angle.glsl"
#include "passes/reflection.glsl"

const bool kIsBiased = kTechnique == kTechniqueProjectedSolidAngleBiased;
const bool kIsProjected = kIsBiased || kTechnique == kTechniqueProjectedSolidAngle; ///< as lines see it
const bool kHasBrdfSamples = kStrategies == kStrategiesDiffuseGgx || kStrategies == kStrategiesDiffuseGgxBounded;
const bool kIsSolidAngle = kTechnique == kTechniqueSolidAngle || kTechnique == kTechniqueClippedSolidAngle;

/// Where a setting has no code: black, and an error of the renderer.
LightSample unknown_sample() {
    note_unknown_setting();
    return LightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0));
}

float unknown_number() {
    note_unknown_setting();
    return 0.0;
}

struct PolygonTechniques {
    PolygonArea area;
    PolygonSolidAngle solid_angle;
    PolygonProjectedSolidAngle projected;
    PolygonProjectedSolidAngleBiased biased;
    PolygonLtc ltc;
    PolygonBrdf brdf;
};

/// \param is_paired whether technique 1 is needed
PolygonTechniques polygon_techniques_prepare(ConvexPolygon light, GlossySurface surface, bool is_paired) {
    PolygonTechniques self;
    if (kTechnique == kTechniqueArea)
        self.area = polygon_area_prepare(light);
    else if (kTechnique == kTechniqueSolidAngle)
        self.solid_angle = polygon_solid_angle_prepare(light);
    else if (kTechnique == kTechniqueClippedSolidAngle)
        self.solid_angle = polygon_clipped_solid_angle_prepare(light);
    else if (kIsBiased)
        self.biased = polygon_projected_solid_angle_biased_prepare(light);
    else if (kIsProjected)
        self.projected = polygon_projected_solid_angle_prepare(light);
    else
        note_unknown_setting();
    if (!is_paired) return self;
    if (kStrategies == kStrategiesDiffuseGgx)
        self.brdf = polygon_brdf_prepare(light, ggx_visible_normals_prepare(surface.wo, surface.alpha));
    else if (kStrategies == kStrategiesDiffuseGgxBounded)
        self.brdf = polygon_brdf_prepare(light, ggx_bounded_visible_normals_prepare(surface.wo, surface.alpha));
    else if (kStrategies != kStrategiesDiffuseLtc)
        note_unknown_setting();
    else if (kIsBiased)
        self.ltc = polygon_ltc_biased_prepare(light, surface.lobe);
    else
        self.ltc = polygon_ltc_prepare(light, surface.lobe);
    return self;
}

LightSample polygon_techniques_sample(PolygonTechniques self, int technique, vec2 u) {
    if (technique == 1) {
        if (kHasBrdfSamples) return polygon_brdf_sample(self.brdf, u);
        if (kStrategies != kStrategiesDiffuseLtc) return unknown_sample();
        if (kIsBiased) return polygon_ltc_biased_sample(self.ltc, u);
        return polygon_ltc_sample(self.ltc, u);
    }
    if (kTechnique == kTechniqueArea) return polygon_area_sample(self.area, u);
    if (kTechnique == kTechniqueSolidAngle) return polygon_solid_angle_sample(self.solid_angle, u);
    if (kTechnique == kTechniqueClippedSolidAngle) return polygon_clipped_solid_angle_sample(self.solid_angle, u);
    if (kIsBiased) return polygon_projected_solid_angle_biased_sample(self.biased, u);
    if (kIsProjected) return polygon_projected_solid_angle_sample(self.projected, u);
    return unknown_sample();
}

/// Of both techniques. Pairs begin with a solid angle or a projected one.
vec2 polygon_techniques_pdf(PolygonTechniques self, vec3 wi) {
    vec2 pdf;
    if (kTechnique == kTechniqueSolidAngle)
        pdf.x = polygon_solid_angle_pdf(self.solid_angle, wi);
    else if (kIsBiased)
        pdf.x = polygon_projected_solid_angle_biased_pdf(self.biased, wi);
    else if (kIsProjected)
        pdf.x = polygon_projected_solid_angle_pdf(self.projected, wi);
    else
        pdf.x = unknown_number();
    if (kStrategies == kStrategiesDiffuseLtc)
        pdf.y = polygon_ltc_pdf(self.ltc, wi);
    else if (kHasBrdfSamples)
        pdf.y = polygon_brdf_pdf(self.brdf, wi);
    else
        pdf.y = unknown_number();
    return pdf;
}

/// What both techniques know of the integrals of the normalised components: nothing of what the BRDF samples.
vec2 polygon_techniques_integrals(PolygonTechniques self) {
    float measure;
    if (kTechnique == kTechniqueSolidAngle)
        measure = polygon_solid_angle_measure(self.solid_angle);
    else if (kIsBiased)
        measure = polygon_projected_solid_angle_biased_measure(self.biased);
    else if (kIsProjected)
        measure = polygon_projected_solid_angle_measure(self.projected);
    else
        measure = unknown_number();
    return vec2((1.0 / kNusseltPi) * measure,
                kStrategies == kStrategiesDiffuseLtc ? polygon_ltc_measure(self.ltc) : 0.0);
}

struct LineTechniques {
    LineArea area;
    LineSolidAngle solid_angle;
    LineProjectedSolidAngle projected;
    LineLtc ltc;
};

/// \copydoc polygon_techniques_prepare
LineTechniques line_techniques_prepare(LineSegment light, GlossySurface surface, bool is_paired) {
    LineTechniques self;
    if (kTechnique == kTechniqueArea)
        self.area = line_area_prepare(light);
    else if (kTechnique == kTechniqueSolidAngle)
        self.solid_angle = line_solid_angle_prepare(light);
    else if (kTechnique == kTechniqueClippedSolidAngle)
        self.solid_angle = line_clipped_solid_angle_prepare(light);
    else if (kIsProjected)
        self.projected = line_projected_solid_angle_prepare(light);
    else
        note_unknown_setting();
    if (is_paired) self.ltc = line_ltc_prepare(light, surface.lobe);
    return self;
}

LightSample line_techniques_sample(LineTechniques self, int technique, float u) {
    if (technique == 1) return line_ltc_sample(self.ltc, u);
    if (kTechnique == kTechniqueArea) return line_area_sample(self.area, u);
    if (kIsSolidAngle) return line_solid_angle_sample(self.solid_angle, u);
    if (kIsProjected) return line_projected_solid_angle_sample(self.projected, u);
    return unknown_sample();
}

/// Of both techniques. Pairs begin with a projected solid angle.
vec2 line_techniques_pdf(LineTechniques self, vec3 wi) {
    return vec2(line_projected_solid_angle_pdf(self.projected, wi), line_ltc_pdf(self.ltc, wi));
}

vec2 line_techniques_integrals(LineTechniques self) {
    return vec2((1.0 / kNusseltPi) * line_projected_solid_angle_measure(self.projected), line_ltc_measure(self.ltc));
}

struct TubeTechniques {
    CylinderArea area;
    CylinderSolidAngle solid_angle;
    CylinderProjectedSolidAngle projected;
    CylinderLtc ltc;
};

/// \copydoc polygon_techniques_prepare
TubeTechniques tube_techniques_prepare(Cylinder light, GlossySurface surface, bool is_paired) {
    TubeTechniques self;
    if (kTechnique == kTechniqueArea)
        self.area = cylinder_area_prepare(light);
    else if (kIsSolidAngle)
        self.solid_angle = cylinder_solid_angle_prepare(light);
    else if (kIsProjected)
        self.projected = cylinder_projected_solid_angle_prepare(light);
    else
        note_unknown_setting();
    if (is_paired) self.ltc = cylinder_ltc_prepare(light, surface.lobe);
    return self;
}

LightSample tube_techniques_sample(TubeTechniques self, int technique, vec2 u) {
    if (technique == 1) return cylinder_ltc_sample(self.ltc, u);
    if (kTechnique == kTechniqueArea) return cylinder_area_sample(self.area, u);
    if (kIsSolidAngle) return cylinder_solid_angle_sample(self.solid_angle, u);
    if (kIsProjected) return cylinder_projected_solid_angle_sample(self.projected, u);
    return unknown_sample();
}

/// Of both techniques. Pairs begin with a projected solid angle.
vec2 tube_techniques_pdf(TubeTechniques self, vec3 wi) {
    return vec2(cylinder_projected_solid_angle_pdf(self.projected, wi), cylinder_ltc_pdf(self.ltc, wi));
}

vec2 tube_techniques_integrals(TubeTechniques self) {
    return vec2((1.0 / kNusseltPi) * cylinder_projected_solid_angle_measure(self.projected),
                cylinder_ltc_measure(self.ltc));
}

#endif
