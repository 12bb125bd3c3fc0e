#ifndef NUSSELT_PASSES_ROUNDS_ROUND_SAMPLES_GLSL
#define NUSSELT_PASSES_ROUNDS_ROUND_SAMPLES_GLSL
/// Techniques for spheres, disks, ellipses and ellipsoids, and the loop that samples them.

#include "passes/rounds/round.glsl"
#include "passes/lights/techniques.glsl"

#if ROUND_LIGHTS
#include "nusselt/cones/cone_clipped_solid_angle.glsl"
#include "nusselt/cones/cone_ltc.glsl"
#include "nusselt/cones/cone_projected_solid_angle.glsl"
#include "nusselt/cones/cone_solid_angle.glsl"
#include "nusselt/cones/ellipse_area.glsl"

/// There are no samples of the BRDF for round lights.
bool has_pair(const RoundShape light, const GlossySurface surface) {
    return kStrategies == kStrategiesDiffuseLtc && glossy_surface_is_glossy(surface);
}

struct RoundTechniques {
    bool is_by_area;
    EllipseArea area;
    ConeSolidAngle solid_angle;
    ConeClippedSolidAngle clipped;
    ConeProjectedSolidAngle projected;
    ConeLtc ltc;
};

/// Solid lights have no samples by area: they are sampled by solid angle instead.
RoundTechniques prepare_techniques(const RoundShape light, const GlossySurface surface, bool is_paired) {
    RoundTechniques self;
    self.is_by_area = kTechnique == kTechniqueArea && kHasEllipses && light.is_flat;
    if (self.is_by_area)
        self.area = ellipse_area_prepare(fixed_ellipse_of(light));
    else if (kTechnique == kTechniqueClippedSolidAngle)
        self.clipped = cone_clipped_solid_angle_of(view_of(light));
    else if (kTechnique == kTechniqueSolidAngle || kTechnique == kTechniqueArea)
        self.solid_angle = cone_solid_angle_of(view_of(light));
    else if (kIsProjected)
        self.projected = cone_projected_solid_angle_of(view_of(light));
    else
        note_unknown_setting();
    if (is_paired) self.ltc = cone_ltc_of(view_of(light, surface.lobe), surface.lobe);
    return self;
}

LightSample techniques_sample(const RoundTechniques self, int technique, vec2 u) {
    if (technique == 1) return cone_ltc_sample(self.ltc, u);
    if (self.is_by_area) return ellipse_area_sample(self.area, u);
    if (kTechnique == kTechniqueClippedSolidAngle) return cone_clipped_solid_angle_sample(self.clipped, u);
    if (kTechnique == kTechniqueSolidAngle || kTechnique == kTechniqueArea)
        return cone_solid_angle_sample(self.solid_angle, u);
    if (kIsProjected) return cone_projected_solid_angle_sample(self.projected, u);
    return unknown_sample();
}

/// The densities of both techniques. Pairs begin with a projected solid angle.
vec2 techniques_pdf(const RoundTechniques self, vec3 wi) {
    return vec2(cone_projected_solid_angle_pdf(self.projected, wi), cone_ltc_pdf(self.ltc, wi));
}

vec2 techniques_integrals(const RoundTechniques self) {
    return vec2((1.0 / kNusseltPi) * cone_projected_solid_angle_measure(self.projected), cone_ltc_measure(self.ltc));
}

/// From inside, where all directions lead to the light, it is a little too large: see faces_solid_light(). Shadow rays end where
/// it really is.
void modulate(const LocalRound light, inout DirectLightSample s) {
    if (!kHasEllipsoids || !light.inside) return;
    vec3 origin = in_unit_sphere(light.index, light.position - to_vec(round_lights[light.index].center));
    vec3 direction = in_unit_sphere(light.index, frame_to_world(light.shading, s.wi));
    float a = dot(direction, direction);
    float along = dot(origin, direction);
    float distance = nusselt_length(origin);
    float root = along * along - a * ((distance - 1.0) * (distance + 1.0));
    // No shorter, because a ray needs a direction.
    const float shortest = 1e-3;
    float way = nusselt_max(sqrt(nusselt_max(root, 0.0)) - along, shortest * sqrt(a));
    s.p = (way / a) * s.wi;
}

#define LOCAL_LIGHT LocalRound
#define TECHNIQUES RoundTechniques
#include "passes/lights/add_light.glsl"
#undef LOCAL_LIGHT
#undef TECHNIQUES

void add_rounds(inout Estimate estimate) {
    for (uint i = first_index(kRoundKind); kHasRounds && i < end_index(kRoundKind); ++i)
        add_light(estimate, local_round(estimate.surface, i));
}
#else
void add_rounds(inout Estimate estimate) {}
#endif

#endif
