/// Samples all lights and sums up what surfaces reflect, as src/render_cpu/kernel/paired_techniques.h does. The entry point
/// must define occluded(), which traces a shadow ray, before it includes this file.

#include "nusselt/estimate/direct_light.glsl"
#include "nusselt/random/light_random.glsl"
#include "passes/lights.glsl"
#include "passes/lights/techniques.glsl"
#include "passes/shading.glsl"

/// Heuristics and samplers must have the same numbers here and in shaders/nusselt: otherwise an array has no elements, which
/// does not compile.
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
    int z_sobol[kSamplerZSobol == kNusseltSamplerZSobol ? 1 : 0];
    int blue_noise[kSamplerBlueNoise == kNusseltSamplerBlueNoise ? 1 : 0];
};

/// Those of data/blue-noise.bin.
layout(set = 0, binding = kFirstBindingAfterLights + 4, std430) readonly buffer BlueNoise { uint blue_noise_words[]; };

/// Occluders count up to this fraction of the distance to the light, as nusselt::kShadowEnd.
const float kShadowEnd = 0.9999;

/// A shading point, the light that it reflects, and the sum over samples of one light.
struct Estimate {
    Surface surface;
    Reflection reflection;
    ivec2 pixel;
    vec3 radiance;
    CompensatedSum sum;
    Counts counts;
};

/// Whether the surface sees a point. \param p relative to the position, in shading space
bool is_visible(inout Estimate estimate, vec3 p) {
    Surface surface = estimate.surface;
    vec3 to_light = frame_to_world(surface.shading, p);
    if (!(dot(surface.geometric_normal, to_light) > 0.0)) return false;
    ++estimate.counts.shadow_rays;
    vec3 offset = surface.offset * surface.geometric_normal;
    return !occluded(surface.position + offset, to_light - offset, kShadowEnd);
}

/// Traces the shadow ray of a sample and adds its contribution.
void add_sample(inout Estimate estimate, const DirectLightSample s) {
    // The direction and the point are undefined where the density is 0.
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

/// The contribution of a sample through all components of the BRDF, where it is the only technique.
DirectLightSample reflect_sample(const Reflection reflection, const LightSample s) {
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

/// \param integrals over the light, of the normalised components
TechniquePair make_technique_pair(const GlossySurface surface, vec2 integrals) {
    DirectLight estimator = direct_light_prepare(surface.diffuse_albedo, surface.specular_albedo, integrals.x, integrals.y,
                                                 1.0, 1.0);
    return TechniquePair(estimator, one_sample_choice_prepare(estimator.techniques));
}

/// The same for a light whose radiance varies.
/// \param diffuse, specular integrals of the normalised components times radiance
TechniquePair make_technique_pair(const GlossySurface surface, vec3 diffuse, vec3 specular) {
    DirectLight estimator = direct_light_prepare(surface.diffuse_albedo, surface.specular_albedo, 1.0, 1.0, 1.0, 1.0);
    estimator.techniques.unshadowed[0] *= diffuse;
    estimator.techniques.unshadowed[1] *= specular;
    return TechniquePair(estimator, one_sample_choice_prepare(estimator.techniques));
}

/// How many samples share the number of a sample.
int samples_per_number(bool is_paired) { return is_paired && frame.mis != kNusseltMisOneSample ? 2 : 1; }

/// Which technique takes a sample, and with which random numbers.
struct Draw {
    int technique;
    vec2 u;
};

/// \param pair the number of the pair of random numbers: that of the technique, unless a random number chooses it
Draw choose_technique(bool is_paired, const TechniquePair techniques, int pair, vec2 u) {
    if (!is_paired || frame.mis != kNusseltMisOneSample) return Draw(pair, u);
    OneSampleDecision decision = one_sample_choice_decide(techniques.choice, u.x);
    return Draw(decision.chosen, vec2(decision.u, u.y));
}

/// \param components of the BRDF in the direction of the sample
/// \param pdf        the densities of both techniques there
DirectLightSample combine(const TechniquePair techniques, const BrdfComponents components, int technique,
                          const LightSample s, vec2 pdf) {
    MisSample at = direct_light_densities_at(techniques.estimator, s, pdf.x, pdf.y, components);
    if (frame.mis == kNusseltMisOneSample)
        return direct_light_combined(s, one_sample_choice_estimate(techniques.choice, at));
    return direct_light_combined(
        s, mis_estimate(frame.mis, technique, frame.visibility_estimate, techniques.estimator.techniques, at));
}

uint blue_noise_at(uint index) { return blue_noise_rank(blue_noise_words[index / 2u], index); }

/// \param index of the sample in this frame
vec2 random_for_light(ivec2 pixel, uint index, uint light, int pair) {
    uint x = uint(scene.x_begin + pixel.x);
    uint y = uint(scene.y_begin + pixel.y);
    uvec2 ranks = uvec2(0u);
    if (kSampler == kSamplerBlueNoise) {
        uvec2 at = light_blue_noise_indices(frame.seed, x, y, light, uint(pair));
        ranks = uvec2(blue_noise_at(at.x), blue_noise_at(at.y));
    }
    return light_random(kSampler, frame.seed, x, y, frame.number * frame.light_samples + index,
                        frame.count * frame.light_samples, light, uint(pair), ranks);
}

#include "passes/lights/environment_samples.glsl"
#include "passes/lights/line_samples.glsl"
#include "passes/lights/one_direction_samples.glsl"
#include "passes/lights/polygon_samples.glsl"
#include "passes/rounds/round_samples.glsl"

vec3 reflected_light(const Surface surface, ivec2 pixel, inout Counts counts) {
    Estimate reflected;
    reflected.surface = surface;
    reflected.reflection = make_reflection(surface);
    reflected.pixel = pixel;
    reflected.counts = counts;
    reflected.radiance = vec3(0.0);
    ADD_ALL_LIGHTS
    counts = reflected.counts;
    return reflected.radiance;
}

#include "passes/pixel_radiance.glsl"
