/// Lights of one kind by two techniques: one of the light for the diffuse component, and one for the specular
/// component, whose integral is unknown.

#include "@file@"
#include "@lobe_file@"
#include "estimate.glsl"

vec3 reflect_@kind@(Surface surface, Reflection reflection, int index) {
    int number = @kind@_numbers[index];
    @Shape@ light = local_@kind@(surface, index);
    if (!is_lit(surface, light, number)) return vec3(0.0);
    GlossySurface glossy = reflection.glossy;
    @Technique@ diffuse = @prepare@(light);
    @Lobe@ specular = @lobe_prepare@;
    Pair pair = make_pair(glossy, (1.0 / kNusseltPi) * @queries@_measure(diffuse), 0.0);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < pair.drawn_count * sample_count; ++i) {
        Draw draw = choose_draw(pair, i, number);
        LightSample s;
        if (draw.technique == 0)
            s = @technique@_sample(diffuse, draw.u.@u@);
        else
            s = @lobe@_sample(specular, draw.u.@u@);
        s = direct_light_drawn(pair.estimator, draw.technique, s);
        sum += combined_contribution(surface, reflection, pair, draw.technique, s, @queries@_pdf(diffuse, s.wi),
                                     @lobe_queries@_pdf(specular, s.wi));
    }
    return 1.0 / float(sample_count) * @kind@_emission(index) * sum;
}
