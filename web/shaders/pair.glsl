/// Lights of one kind by two techniques, one for each component of the BRDF, combined by a heuristic of multiple
/// importance sampling.

#include "@file@"
#include "@lobe_file@"
#include "pair_settings.glsl"

vec3 reflect_@kind@(Surface surface, Reflection reflection, int index) {
    int number = @kind@_numbers[index];
    @Shape@ light = local_@kind@(surface, index);
    if (!is_lit(surface, light, number)) return vec3(0.0);
    GlossySurface glossy = reflection.glossy;
    @Technique@ diffuse = @prepare@(light);
    @Lobe@ specular = @lobe_prepare@;
    float diffuse_integral = (1.0 / kNusseltPi) * @technique@_measure(diffuse);
    DirectLight estimator = direct_light_prepare(glossy.diffuse_albedo, glossy.specular_albedo, diffuse_integral,
                                                 @lobe_integral@, 1.0, 1.0);
    OneSampleChoice choice = one_sample_choice_prepare(estimator.techniques);
    bool is_one_sample = heuristic == kNusseltMisOneSample;
    // Without a lobe, the technique for the diffuse component is alone.
    int drawn_count = is_one_sample || !estimator.glossy ? 1 : 2;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < drawn_count * sample_count; ++i) {
        int drawn = i % drawn_count;
        vec2 u = random_for_light(i / drawn_count, number, drawn);
        if (is_one_sample && estimator.glossy) {
            OneSampleDecision decision = one_sample_choice_decide(choice, u.x);
            drawn = decision.chosen;
            u.x = decision.u;
        }
        LightSample s;
        if (drawn == 0)
            s = @technique@_sample(diffuse, @u@);
        else
            s = @lobe_sample@(specular, @u@);
        BrdfComponents brdf = reflection_eval_components(reflection, s.wi);
        MisSample at = direct_light_densities_at(estimator, s, @technique@_pdf(diffuse, s.wi),
                                                 @lobe@_pdf(specular, s.wi), brdf);
        MisEstimate estimate;
        if (!estimator.glossy)
            estimate = MisEstimate(ratio_or_zero(at.component[0] + at.component[1], vec3(at.pdf[0])), vec3(0.0));
        else if (is_one_sample)
            estimate = one_sample_choice_estimate(choice, at);
        else
            estimate = mis_estimate(heuristic, drawn, visibility_estimate, estimator.techniques, at);
        sum += contribution(surface, direct_light_combined(s, estimate));
    }
    return 1.0 / float(sample_count) * @kind@_emission(index) * sum;
}
