#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_SAMPLES_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_SAMPLES_GLSL
/// Techniques for polygonal lights and portals, and the loop that samples them.

#include "nusselt/sampling/polygon_area.glsl"
#include "nusselt/sampling/polygon_brdf.glsl"
#include "nusselt/sampling/polygon_clipped_solid_angle.glsl"
#include "nusselt/sampling/polygon_ltc.glsl"
#include "nusselt/sampling/polygon_ltc_biased.glsl"
#include "nusselt/sampling/polygon_projected_solid_angle.glsl"
#include "nusselt/sampling/polygon_projected_solid_angle_biased.glsl"
#include "nusselt/sampling/polygon_solid_angle.glsl"
#include "passes/lights/portal.glsl"
#include "passes/lights/techniques.glsl"

bool has_pair(const ConvexPolygon light, const GlossySurface surface) {
    return kStrategies != kStrategiesDiffuse && glossy_surface_is_glossy(surface);
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
PolygonTechniques prepare_techniques(const ConvexPolygon light, const GlossySurface surface, bool is_paired) {
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

LightSample techniques_sample(const PolygonTechniques self, int technique, vec2 u) {
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

/// The densities of both techniques. Pairs begin with a solid angle or a projected one.
vec2 techniques_pdf(const PolygonTechniques self, vec3 wi) {
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

/// The integrals of the normalised components, as far as both techniques know them: 0 for samples of the BRDF.
vec2 techniques_integrals(const PolygonTechniques self) {
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

/// Multiplies a sample by the radiance at its point and in its direction over the mean.
void modulate(const LocalPolygon light, inout DirectLightSample s) {
    if (kHasPortals && light.environment >= 0) {
        // Light comes from beyond the scene.
        s.p = (4.0 * scene.radius) * s.wi;
        uint index = uint(light.environment);
        if (kHasMappedPortals && (!kHasUniformPortals || environment_lights[index].first_map_word != kNoWords))
            s.shadowed = radiance_towards(index, frame_to_world(light.shading, s.wi)) * s.shadowed;
    }
    if (kHasProfiledPolygons && light.profile != kNoWords)
        s.shadowed = relative_radiance(light.profile, light.axes, -s.wi) * s.shadowed;
    if (!kHasTexturedPolygons || light.texture_number < 0) return;
    vec3 radiance = texture_radiance(light.texture_number, texture_plane_coordinates(light.plane, s.p));
    s.shadowed = (to_vec(polygon_textures[light.texture_number].inverse_mean) * radiance) * s.shadowed;
}

#define LOCAL_LIGHT LocalPolygon
#define TECHNIQUES PolygonTechniques
#include "passes/lights/add_light.glsl"
#undef LOCAL_LIGHT
#undef TECHNIQUES

#if EMISSION_CELLS
#include "passes/cells/polygon_cell_samples.glsl"
#else
#include "passes/lights/polygon_measure_samples.glsl"
#endif

void add_polygons(inout Estimate estimate) {
    for (uint i = 0u; (kHasAnyPolygons || kHasPortals) && i < polygon_or_portal_count(); ++i) {
        PolygonOrPortal light = polygon_or_portal(i);
        if (has_shape(light)) add_polygon(estimate, local_polygon_or_portal(estimate.surface, light));
    }
}

#endif
