#ifndef PAGE_ESTIMATE_GLSL
#define PAGE_ESTIMATE_GLSL
/// How the samples of two techniques are combined, one for each component of the BRDF.

#include "pair_settings.glsl"

/// Two techniques for one light.
struct Pair {
    DirectLight estimator;
    OneSampleChoice choice;
    bool is_one_sample; ///< whether a random number chooses the technique
    int drawn_count;    ///< techniques that take a sample of each number
};

/// \param diffuse_integral, specular_integral of the normalised components over the light
Pair make_pair(GlossySurface surface, float diffuse_integral, float specular_integral) {
    DirectLight estimator = direct_light_prepare(surface.diffuse_albedo, surface.specular_albedo, diffuse_integral,
                                                 specular_integral, 1.0, 1.0);
    bool is_one_sample = estimator.glossy && heuristic == kNusseltMisOneSample;
    // Without a specular component, the technique for the diffuse one is alone.
    return Pair(estimator, one_sample_choice_prepare(estimator.techniques), is_one_sample,
                is_one_sample || !estimator.glossy ? 1 : 2);
}

/// Which technique takes a sample, and with which random numbers.
struct Draw {
    int technique;
    vec2 u;
};

/// \param i     number of the sample in this frame, among drawn_count * sample_count
/// \param light number of the light
Draw choose_draw(Pair pair, int i, int light) {
    int drawn = i % pair.drawn_count;
    vec2 u = random_for_light(i / pair.drawn_count, light, drawn);
    if (!pair.is_one_sample) return Draw(drawn, u);
    OneSampleDecision decision = one_sample_choice_decide(pair.choice, u.x);
    return Draw(decision.chosen, vec2(decision.u, u.y));
}

/// What a sample adds for an emission of 1. Traces its shadow ray.
/// \param s                         by direct_light_drawn()
/// \param diffuse_pdf, specular_pdf densities of both techniques in its direction
vec3 combined_contribution(Surface surface, Reflection reflection, Pair pair, int drawn, LightSample s,
                           float diffuse_pdf, float specular_pdf) {
    BrdfComponents brdf = reflection_eval_components(reflection, s.wi);
    MisSample at = direct_light_densities_at(pair.estimator, s, diffuse_pdf, specular_pdf, brdf);
    MisEstimate estimate;
    if (!pair.estimator.glossy)
        estimate = MisEstimate(ratio_or_zero(at.component[0] + at.component[1], vec3(at.pdf[0])), vec3(0.0));
    else if (pair.is_one_sample)
        estimate = one_sample_choice_estimate(pair.choice, at);
    else
        estimate = mis_estimate(heuristic, drawn, visibility_estimate, pair.estimator.techniques, at);
    return contribution(surface, direct_light_combined(s, estimate));
}

#endif
