/// Lights of one kind by one sample for each component of the BRDF, combined by a heuristic of multiple importance
/// sampling. The clamped cosine is a lobe, too: both samples are of linearly transformed cosines, by the same code,
/// which halves the time to compile. The first one is the projected solid angle.

#include "@lobe_file@"
#include "pair_settings.glsl"

vec3 reflect_@kind@(Surface surface, Reflection reflection, int index) {
    int number = @kind@_numbers[index];
    @Shape@ light = local_@kind@(surface, index);
    if (!is_lit(surface, light, number)) return vec3(0.0);
    GlossySurface glossy = reflection.glossy;
    bool is_glossy = glossy_surface_is_glossy(glossy);
    Ltc cosine = ltc_prepare(LtcCoefficients(1.0, 0.0, 1.0, 0.0, 1.0, 0.0));
    @Lobe@ technique[2];
    for (int k = 0; k < (is_glossy ? 2 : 1); ++k) {
        Ltc lobe = cosine;
        if (k == 1) lobe = glossy.lobe;
        technique[k] = @lobe_prepare@;
    }
    if (!is_glossy) technique[1] = technique[0];
    DirectLight estimator = direct_light_prepare(glossy.diffuse_albedo, glossy.specular_albedo, @lobe@_measure(technique[0]),
                                                 @lobe@_measure(technique[1]), 1.0, 1.0);
    OneSampleChoice choice = one_sample_choice_prepare(estimator.techniques);
    bool is_one_sample = is_glossy && heuristic == kNusseltMisOneSample;
    // Without a specular component, the first technique is alone.
    int drawn_count = is_one_sample || !is_glossy ? 1 : 2;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < drawn_count * sample_count; ++i) {
        int drawn = i % drawn_count;
        vec2 u = random_for_light(i / drawn_count, number, drawn);
        if (is_one_sample) {
            OneSampleDecision decision = one_sample_choice_decide(choice, u.x);
            drawn = decision.chosen;
            u.x = decision.u;
        }
        LightSample s = direct_light_drawn(estimator, drawn, @lobe_sample@(technique[drawn], @u@));
        BrdfComponents brdf = reflection_eval_components(reflection, s.wi);
        MisSample at = direct_light_densities_at(estimator, s, @lobe@_pdf(technique[0], s.wi),
                                                 @lobe@_pdf(technique[1], s.wi), brdf);
        MisEstimate estimate;
        if (!is_glossy)
            estimate = MisEstimate(ratio_or_zero(at.component[0], vec3(at.pdf[0])), vec3(0.0));
        else if (is_one_sample)
            estimate = one_sample_choice_estimate(choice, at);
        else
            estimate = mis_estimate(heuristic, drawn, visibility_estimate, estimator.techniques, at);
        sum += contribution(surface, direct_light_combined(s, estimate));
    }
    return 1.0 / float(sample_count) * @kind@_emission(index) * sum;
}
