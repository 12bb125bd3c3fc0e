#ifndef NUSSELT_PASSES_LIGHTS_LINE_SAMPLES_GLSL
#define NUSSELT_PASSES_LIGHTS_LINE_SAMPLES_GLSL
/// Techniques for linear lights, strips and tubes, and the loop that samples these lights.

#include "nusselt/sampling/cylinder_area.glsl"
#include "nusselt/sampling/cylinder_ltc.glsl"
#include "nusselt/sampling/cylinder_projected_solid_angle.glsl"
#include "nusselt/sampling/cylinder_solid_angle.glsl"
#include "nusselt/sampling/line_area.glsl"
#include "nusselt/sampling/line_ltc.glsl"
#include "nusselt/sampling/line_projected_solid_angle.glsl"
#include "nusselt/sampling/line_solid_angle.glsl"
#include "passes/lights/line.glsl"
#include "passes/lights/techniques.glsl"

/// Samples of the BRDF never hit a line.
bool is_line_paired(const GlossySurface surface) {
    return kStrategies == kStrategiesDiffuseLtc && glossy_surface_is_glossy(surface);
}
bool has_pair(const LineSegment light, const GlossySurface surface) { return is_line_paired(surface); }
bool has_pair(const Cylinder light, const GlossySurface surface) { return is_line_paired(surface); }

struct LineTechniques {
    LineArea area;
    LineSolidAngle solid_angle;
    LineProjectedSolidAngle projected;
    LineLtc ltc;
};

LineTechniques prepare_techniques(const LineSegment light, const GlossySurface surface, bool is_paired) {
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

LightSample techniques_sample(const LineTechniques self, int technique, vec2 u) {
    if (technique == 1) return line_ltc_sample(self.ltc, u.x);
    if (kTechnique == kTechniqueArea) return line_area_sample(self.area, u.x);
    if (kIsSolidAngle) return line_solid_angle_sample(self.solid_angle, u.x);
    if (kIsProjected) return line_projected_solid_angle_sample(self.projected, u.x);
    return unknown_sample();
}

/// The densities of both techniques. Pairs begin with a projected solid angle.
vec2 techniques_pdf(const LineTechniques self, vec3 wi) {
    return vec2(line_projected_solid_angle_pdf(self.projected, wi), line_ltc_pdf(self.ltc, wi));
}

vec2 techniques_integrals(const LineTechniques self) {
    return vec2((1.0 / kNusseltPi) * line_projected_solid_angle_measure(self.projected), line_ltc_measure(self.ltc));
}

struct TubeTechniques {
    CylinderArea area;
    CylinderSolidAngle solid_angle;
    CylinderProjectedSolidAngle projected;
    CylinderLtc ltc;
};

TubeTechniques prepare_techniques(const Cylinder light, const GlossySurface surface, bool is_paired) {
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

LightSample techniques_sample(const TubeTechniques self, int technique, vec2 u) {
    if (technique == 1) return cylinder_ltc_sample(self.ltc, u);
    if (kTechnique == kTechniqueArea) return cylinder_area_sample(self.area, u);
    if (kIsSolidAngle) return cylinder_solid_angle_sample(self.solid_angle, u);
    if (kIsProjected) return cylinder_projected_solid_angle_sample(self.projected, u);
    return unknown_sample();
}

/// The densities of both techniques. Pairs begin with a projected solid angle.
vec2 techniques_pdf(const TubeTechniques self, vec3 wi) {
    return vec2(cylinder_projected_solid_angle_pdf(self.projected, wi), cylinder_ltc_pdf(self.ltc, wi));
}

vec2 techniques_integrals(const TubeTechniques self) {
    return vec2((1.0 / kNusseltPi) * cylinder_projected_solid_angle_measure(self.projected),
                cylinder_ltc_measure(self.ltc));
}

/// Multiplies a sample by the radiance at its point and in its direction over the mean.
void modulate(const LocalLine light, inout DirectLightSample s) {
    if (kHasProfiledLines && has_emission_profile(light.emission_profile))
        s.shadowed = radiance_of_line(light.emission_profile, light.model == kStrip, light.shape.s, -s.wi) * s.shadowed;
    if (kHasTexturedLines && varies(light.radiance))
        s.shadowed = relative_radiance(light.radiance, light.shape, s.p) * s.shadowed;
}
/// Likewise. Samples on a part of the light that does not shine count like those in shadow.
void modulate(const LocalTube light, inout DirectLightSample s) {
    LineSegment axis = light.shape.axis;
    if (kHasTexturedTubes && varies(light.radiance))
        s.shadowed = relative_radiance(light.radiance, axis, s.p) * s.shadowed;
    if (kHasProfiledTubes && has_emission_profile(light.emission_profile)) {
        // With the normal of a cap, or of the lateral surface.
        vec3 from_axis = across(axis, s.p);
        vec3 lateral = from_axis / sqrt(nusselt_max(dot(from_axis, from_axis), kNusseltTiny));
        vec3 normal = meets_cap(light.shape, s.wi) ? axis.s : lateral;
        s.shadowed = radiance_of_tube(light.emission_profile, normal, -s.wi) * s.shadowed;
    }
    if (light.is_open && meets_cap(light.shape, s.wi)) s.shadowed = vec3(0.0);
}

#define LOCAL_LIGHT LocalLine
#define TECHNIQUES LineTechniques
#include "passes/lights/add_light.glsl"
#undef LOCAL_LIGHT
#undef TECHNIQUES

#define LOCAL_LIGHT LocalTube
#define TECHNIQUES TubeTechniques
#include "passes/lights/add_light.glsl"
#undef LOCAL_LIGHT
#undef TECHNIQUES

#if LINE_CELLS
/// Whether the radiance along lights decides where samples are. Other strategies than the one with lobes take a single technique:
/// lines and tubes have no samples of the BRDF.
const bool kHasLineCells = kEmissionSampling == kEmissionSamplingProduct && kIsProjected;
#else
const bool kHasLineCells = false;
#endif

const bool kHasLinesByMeasure = kHasLines || kHasProfiledLines || (kHasTexturedLines && !kHasLineCells);
const bool kHasTubesByMeasure = kHasTubes || kHasProfiledTubes || (kHasTexturedTubes && !kHasLineCells);

/// Adds samples by the measure of the technique.
void add_by_measure(inout Estimate estimate, const LocalLine light) {
    if (kHasTubesByMeasure && is_tube(light))
        add_light(estimate, tube_of(light));
    else if (kHasLinesByMeasure)
        add_light(estimate, light);
}

#if LINE_CELLS
#include "passes/cells/line_cell_samples.glsl"
#else
void add_line(inout Estimate estimate, const LocalLine light) { add_by_measure(estimate, light); }
#endif

void add_lines(inout Estimate estimate) {
    for (uint i = first_index(kLineKind); (kHasAnyLines || kHasAnyTubes) && i < end_index(kLineKind); ++i)
        add_line(estimate, local_line(estimate.surface, i));
}

#endif
