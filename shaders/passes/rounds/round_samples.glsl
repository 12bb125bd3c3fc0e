#ifndef NUSSELT_PASSES_ROUNDS_ROUND_SAMPLES_GLSL
#define NUSSELT_PASSES_ROUNDS_ROUND_SAMPLES_GLSL
/// Techniques for spheres, disks, ellipses and ellipsoids, and the loop that samples them.

#include "passes/rounds/round.glsl"
#include "passes/lights/techniques.glsl"

#if ROUND_LIGHTS
#include "nusselt/cones/cone_clipped_solid_angle.glsl"
#include "nusselt/cones/cone_solid_angle.glsl"
#include "nusselt/cones/cosine_cone.glsl"
#include "nusselt/cones/ellipse_area.glsl"

/// There are no samples of the BRDF for round lights.
bool has_pair(const RoundShape light, const GlossySurface surface) {
    return kStrategies == kStrategiesDiffuseLtc && glossy_surface_is_glossy(surface);
}

/// The technique in proportion to the cosine of a surface or of a lobe, in cosine space.
struct RoundCosine {
    RoundLightView view;
    CosineCone cone;
};

/// ConeProjectedSolidAngle and ConeLtc, which have the same technique in two spaces, share their code: drivers take
/// long to compile it twice, and one has crashed.
struct RoundTechniques {
    bool is_by_area;
    EllipseArea area;
    ConeSolidAngle solid_angle;
    ConeClippedSolidAngle clipped;
    RoundCosine diffuse, specular;
    Ltc lobe; ///< of the specular component
};

void prepare_cosines(const RoundShape light, const GlossySurface surface, bool is_paired, inout RoundTechniques self) {
    self.lobe = surface.lobe;
    [[dont_unroll]] for (int technique = 0; technique < (is_paired ? 2 : 1); ++technique) {
        RoundCosine cosine;
        if (technique == 1)
            cosine.view = view_of(light, surface.lobe);
        else
            cosine.view = view_of(light);
        cosine.cone = make_cosine_cone(cosine.view.cone);
        if (technique == 1)
            self.specular = cosine;
        else
            self.diffuse = cosine;
    }
}

RoundCosine cosine_of(const RoundTechniques self, int technique) {
    if (technique == 1) return self.specular;
    return self.diffuse;
}

float cosine_pdf(const RoundTechniques self, int technique, vec3 wi) {
    vec3 in_cosine_space = wi;
    float per_cosine = nusselt_max(wi.z, 0.0);
    if (technique == 1) {
        in_cosine_space = nusselt_normalize(ltc_to_cosine(self.lobe, wi));
        per_cosine = kNusseltPi * ltc_density(self.lobe, wi);
    }
    float density = per_cosine * cosine_cone_density_per_cosine(cosine_of(self, technique).cone, in_cosine_space);
    return is_finite(density) ? density : 0.0;
}

LightSample cosine_sample(const RoundTechniques self, int technique, vec2 u) {
    RoundCosine cosine = cosine_of(self, technique);
    ConeSample s = cosine_cone_sample(cosine.cone, u);
    vec3 wi = s.wi;
    if (technique == 1) wi = nusselt_normalize(ltc_to_shading(self.lobe, wi));
    if (!(cosine_cone_measure(cosine.cone) > 0.0)) wi = vec3(0.0, 0.0, 1.0);
    float distance = nusselt_max(dot(wi, round_light_point(cosine.view, s.disk, wi)), 0.0);
    return LightSample(wi, cosine_pdf(self, technique, wi), (cosine.view.inverse_scale * distance) * wi);
}

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
        prepare_cosines(light, surface, is_paired, self);
    else
        note_unknown_setting();
    return self;
}

LightSample techniques_sample(const RoundTechniques self, int technique, vec2 u) {
    if (kIsProjected) return cosine_sample(self, technique, u);
    if (self.is_by_area) return ellipse_area_sample(self.area, u);
    if (kTechnique == kTechniqueClippedSolidAngle) return cone_clipped_solid_angle_sample(self.clipped, u);
    if (kTechnique == kTechniqueSolidAngle || kTechnique == kTechniqueArea)
        return cone_solid_angle_sample(self.solid_angle, u);
    return unknown_sample();
}

/// The densities of both techniques. Pairs begin with a projected solid angle.
vec2 techniques_pdf(const RoundTechniques self, vec3 wi) {
    vec2 pdf;
    [[dont_unroll]] for (int technique = 0; technique < 2; ++technique)
        pdf[technique] = cosine_pdf(self, technique, wi);
    return pdf;
}

vec2 techniques_integrals(const RoundTechniques self) {
    return vec2((1.0 / kNusseltPi) * cosine_cone_measure(self.diffuse.cone),
                nusselt_min((1.0 / kNusseltPi) * cosine_cone_measure(self.specular.cone), 1.0));
}

/// From inside, where all directions lead to the light, it is a little too large: see faces_solid_light(). Shadow rays
/// end where it really is.
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
