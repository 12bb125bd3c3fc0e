/// Reflected light by samples of all lights, as src/render_cpu/kernel/paired_techniques.cpp. The entry point includes one of
/// the ways to trace shadow rays before this file.

#include "nusselt/estimate/direct_light.glsl"
#include "nusselt/random/light_random.glsl"
#include "passes/lights.glsl"
#include "passes/shading.glsl"
#include "passes/techniques.glsl"

/// Heuristics and samplers have the same numbers here and in shaders/nusselt: otherwise an array has no elements, which does
/// not compile.
struct SameNumbers {
    int balance[kMisBalance == kNusseltMisBalance ? 1 : 0];
    int power[kMisPower == kNusseltMisPower ? 1 : 0];
    int weighted_balance[kMisWeightedBalance == kNusseltMisWeightedBalance ? 1 : 0];
    int clamped_optimal[kMisClampedOptimal == kNusseltMisClampedOptimal ? 1 : 0];
    int optimal[kMisOptimal == kNusseltMisOptimal ? 1 : 0];
    int one_sample[kMisOneSample == kNusseltMisOneSample ? 1 : 0];
    int separate[kMisSeparate == kNusseltMisSeparate ? 1 : 0];
    int independent[kSamplerIndependent == kNusseltSamplerIndependent ? 1 : 0];
    int sobol[kSamplerSobol == kNusseltSamplerSobol ? 1 : 0];
    int jittered[kSamplerJittered == kNusseltSamplerJittered ? 1 : 0];
    int stratified[kSamplerStratified == kNusseltSamplerStratified ? 1 : 0];
};

/// As nusselt::kShadowEnd: occluders count up to this share of the way.
const float kShadowEnd = 0.9999;

/// A shading point, and the sum over samples of one light.
struct Estimate {
    Surface surface;
    Reflection reflection;
    ivec2 pixel;
    CompensatedSum sum;
    Counts counts;
};

/// Whether the way from the surface to a point is free. \param p relative to the position, in shading space.
bool is_visible(inout Estimate estimate, vec3 p) {
    Surface surface = estimate.surface;
    vec3 to_light = frame_to_world(surface.shading, p);
    if (!(dot(surface.geometric_normal, to_light) > 0.0)) return false;
    ++estimate.counts.shadow_rays;
    vec3 offset = surface.offset * surface.geometric_normal;
    return !occluded(surface.position + offset, to_light - offset, kShadowEnd);
}

/// Adds what a sample contributes, after its shadow ray.
void add_sample(inout Estimate estimate, DirectLightSample s) {
    // Direction and point have no meaning without a density.
    bool has_way = s.shadowed == vec3(0.0) || (is_finite(s.wi) && is_finite(s.p));
    if (!(has_way && is_finite(s.shadowed) && is_finite(s.constant))) {
        ++estimate.counts.rejected_samples;
        return;
    }
    vec3 term = s.constant;
    float largest = max(max(s.shadowed.x, s.shadowed.y), s.shadowed.z);
    if (largest > 0.0 && is_visible(estimate, s.p)) term = s.shadowed + s.constant;
    compensated_sum_add(estimate.sum, term);
}

/// What a sample of the only technique contributes through all components of the BRDF.
DirectLightSample reflect_sample(Reflection reflection, LightSample s) {
    // Comparisons with NaN are false: negated they keep it, so that it is counted.
    bool sampled = !(s.pdf == 0.0 || s.wi.z <= 0.0);
    vec3 shadowed = vec3(0.0);
    if (sampled) shadowed = (s.wi.z / s.pdf) * reflection_eval(reflection, s.wi);
    return DirectLightSample(s.wi, s.p, shadowed, vec3(0.0));
}

/// Two techniques for one light, and how their samples are combined.
struct TechniquePair {
    DirectLight estimator;
    OneSampleChoice choice;
};

/// \param integrals of the normalised components over the light.
TechniquePair make_technique_pair(GlossySurface surface, vec2 integrals) {
    DirectLight estimator = direct_light_prepare(surface.diffuse_albedo, surface.specular_albedo, integrals.x, integrals.y,
                                                 1.0, 1.0);
    return TechniquePair(estimator, one_sample_choice_prepare(estimator.techniques));
}

/// How many samples a number of a sample stands for.
int samples_per_number(bool is_paired) { return is_paired && kMis != kNusseltMisOneSample ? 2 : 1; }

/// Which technique takes a sample, and with which random numbers.
struct Draw {
    int technique;
    vec2 u;
};

/// \param pair number of the pair of random numbers: of the technique, unless a random number chooses that.
Draw choose_technique(bool is_paired, TechniquePair techniques, int pair, vec2 u) {
    if (!is_paired || kMis != kNusseltMisOneSample) return Draw(pair, u);
    OneSampleDecision decision = one_sample_choice_decide(techniques.choice, u.x);
    return Draw(decision.chosen, vec2(decision.u, u.y));
}

/// \param pdf densities of both techniques in the direction of the sample.
DirectLightSample combine(TechniquePair techniques, Reflection reflection, int technique, LightSample s, vec2 pdf) {
    MisSample at = direct_light_densities_at(techniques.estimator, s, pdf.x, pdf.y,
                                             reflection_eval_components(reflection, s.wi));
    if (kMis == kNusseltMisOneSample)
        return direct_light_combined(s, one_sample_choice_estimate(techniques.choice, at));
    return direct_light_combined(
        s, mis_estimate(kMis, technique, frame.visibility_estimate, techniques.estimator.techniques, at));
}

/// \param index of the sample in this frame.
vec2 random_for_light(ivec2 pixel, uint index, uint light, int pair) {
    return light_random(kSampler, frame.seed, uint(scene.x_begin + pixel.x), uint(scene.y_begin + pixel.y),
                        frame.number * frame.light_samples + index, frame.count * frame.light_samples, light,
                        uint(pair));
}

void sample_polygon(inout Estimate estimate, LocalPolygon light) {
    GlossySurface glossy = estimate.reflection.glossy;
    bool is_paired = kStrategies != kStrategiesDiffuse && glossy_surface_is_glossy(glossy);
    PolygonTechniques techniques = polygon_techniques_prepare(light.shape, glossy, is_paired);
    TechniquePair pair;
    if (is_paired) pair = make_technique_pair(glossy, polygon_techniques_integrals(techniques));
    for (uint i = frame.first_sample; i < frame.sample_end; ++i) {
        for (int k = 0; k < samples_per_number(is_paired); ++k) {
            vec2 u = random_for_light(estimate.pixel, i, light.role.number, k);
            Draw draw = choose_technique(is_paired, pair, k, u);
            LightSample s = polygon_techniques_sample(techniques, draw.technique, draw.u);
            DirectLightSample result;
            if (is_paired)
                result = combine(pair, estimate.reflection, draw.technique, s, polygon_techniques_pdf(techniques, s.wi));
            else
                result = reflect_sample(estimate.reflection, s);
            add_sample(estimate, result);
        }
    }
}

/// Whether lines and tubes have a second technique: no sample of the BRDF hits a line.
bool is_line_paired(GlossySurface surface) {
    return kStrategies == kStrategiesDiffuseLtc && glossy_surface_is_glossy(surface);
}

void sample_line(inout Estimate estimate, LocalLine light) {
    GlossySurface glossy = estimate.reflection.glossy;
    bool is_paired = is_line_paired(glossy);
    LineTechniques techniques = line_techniques_prepare(light.shape, glossy, is_paired);
    TechniquePair pair;
    if (is_paired) pair = make_technique_pair(glossy, line_techniques_integrals(techniques));
    for (uint i = frame.first_sample; i < frame.sample_end; ++i) {
        for (int k = 0; k < samples_per_number(is_paired); ++k) {
            vec2 u = random_for_light(estimate.pixel, i, light.role.number, k);
            Draw draw = choose_technique(is_paired, pair, k, u);
            LightSample s = line_techniques_sample(techniques, draw.technique, draw.u.x);
            DirectLightSample result;
            if (is_paired)
                result = combine(pair, estimate.reflection, draw.technique, s, line_techniques_pdf(techniques, s.wi));
            else
                result = reflect_sample(estimate.reflection, s);
            add_sample(estimate, result);
        }
    }
}

void sample_tube(inout Estimate estimate, LocalLine light) {
    GlossySurface glossy = estimate.reflection.glossy;
    bool is_paired = is_line_paired(glossy);
    TubeTechniques techniques = tube_techniques_prepare(Cylinder(light.shape, light.radius), glossy, is_paired);
    TechniquePair pair;
    if (is_paired) pair = make_technique_pair(glossy, tube_techniques_integrals(techniques));
    for (uint i = frame.first_sample; i < frame.sample_end; ++i) {
        for (int k = 0; k < samples_per_number(is_paired); ++k) {
            vec2 u = random_for_light(estimate.pixel, i, light.role.number, k);
            Draw draw = choose_technique(is_paired, pair, k, u);
            LightSample s = tube_techniques_sample(techniques, draw.technique, draw.u);
            DirectLightSample result;
            if (is_paired)
                result = combine(pair, estimate.reflection, draw.technique, s, tube_techniques_pdf(techniques, s.wi));
            else
                result = reflect_sample(estimate.reflection, s);
            add_sample(estimate, result);
        }
    }
}

vec3 reflected_light(Surface surface, ivec2 pixel, inout Counts counts) {
    Estimate estimate;
    estimate.surface = surface;
    estimate.reflection = make_reflection(surface);
    estimate.pixel = pixel;
    estimate.counts = counts;
    float scale = 1.0 / float(frame.light_samples);
    vec3 radiance = vec3(0.0);
    for (uint i = frame.first_light; kHasPolygons && i < polygons_end(); ++i) {
        LocalPolygon light = local_polygon(surface, i);
        if (!light.role.is_lit) continue;
        estimate.sum = CompensatedSum(vec3(0.0), vec3(0.0));
        sample_polygon(estimate, light);
        radiance += (scale * light.role.emission) * estimate.sum.sum;
    }
    for (uint i = first_line(); (kHasLines || kHasTubes) && i < lines_end(); ++i) {
        LocalLine light = local_line(surface, i);
        if (!light.role.is_lit) continue;
        estimate.sum = CompensatedSum(vec3(0.0), vec3(0.0));
        if (kHasTubes && light.is_solid)
            sample_tube(estimate, light);
        else if (kHasLines)
            sample_line(estimate, light);
        radiance += (scale * light.role.emission) * estimate.sum.sum;
    }
    counts = estimate.counts;
    return radiance;
}

#include "passes/pixel_radiance.glsl"
