/// Lights of one kind by linearly transformed cosines for both components of the BRDF. The clamped cosine is a lobe,
/// too, whose samples have the density of projected solid angle sampling: the same code for both halves the time to
/// compile.

#include "@lobe_file@"
#include "estimate.glsl"

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
    Pair pair = make_pair(glossy, @lobe_queries@_measure(technique[0]), @lobe_queries@_measure(technique[1]));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < pair.drawn_count * sample_count; ++i) {
        Draw draw = choose_draw(pair, i, number);
        LightSample s = direct_light_drawn(pair.estimator, draw.technique,
                                           @lobe@_sample(technique[draw.technique], draw.u.@u@));
        sum += combined_contribution(surface, reflection, pair, draw.technique, s,
                                     @lobe_queries@_pdf(technique[0], s.wi), @lobe_queries@_pdf(technique[1], s.wi));
    }
    return 1.0 / float(sample_count) * @kind@_emission(index) * sum;
}
