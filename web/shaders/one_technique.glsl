/// Lights of one kind by one technique, whose samples stand for all of the BRDF.

#include "@file@"
#include "samples.glsl"

vec3 reflect_@kind@(Surface surface, Reflection reflection, int index) {
    int number = @kind@_numbers[index];
    @Shape@ light = local_@kind@(surface, index);
    if (!is_lit(surface, light, number)) return vec3(0.0);
    @Technique@ technique = @prepare@(light);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < sample_count; ++i) {
        LightSample s = @technique@_sample(technique, random_for_light(i, number, 0).@u@);
        vec3 shadowed = vec3(0.0);
        // Comparisons with NaN are false: negated they keep it, so that it is counted.
        if (!(s.pdf == 0.0 || s.wi.z <= 0.0)) {
            BrdfComponents brdf = reflection_eval_components(reflection, s.wi);
            shadowed = (s.wi.z / s.pdf) * (brdf.diffuse + brdf.specular);
        }
        sum += contribution(surface, DirectLightSample(s.wi, s.p, shadowed, vec3(0.0)));
    }
    return 1.0 / float(sample_count) * @kind@_emission(index) * sum;
}
