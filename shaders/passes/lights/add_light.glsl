/// Adds samples of one light. A file includes this one for each shape of light, with the types
///
///     LOCAL_LIGHT: a light as a shading point sees it, with the members `shape` and `role`, and a function
///         modulate(light, s): multiplies a sample by what the light emits there, as a part of role.emission;
///     TECHNIQUES: see techniques.glsl.

void add_light(inout Estimate estimate, const LOCAL_LIGHT light) {
    if (!light.role.is_lit) return;
    estimate.sum = CompensatedSum(vec3(0.0), vec3(0.0));
    GlossySurface glossy = estimate.reflection.glossy;
    bool is_paired = has_pair(light.shape, glossy);
    TECHNIQUES techniques = prepare_techniques(light.shape, glossy, is_paired);
    TechniquePair pair;
    if (is_paired) pair = make_technique_pair(glossy, techniques_integrals(techniques));
    for (uint i = frame.first_sample; i < frame.sample_end; ++i) {
        for (int k = 0; k < samples_per_number(is_paired); ++k) {
            vec2 u = random_for_light(estimate.pixel, i, light.role.number, k);
            Draw draw = choose_technique(is_paired, pair, k, u);
            LightSample s = techniques_sample(techniques, draw.technique, draw.u);
            DirectLightSample result;
            if (is_paired)
                result = combine(pair, reflection_eval_components(estimate.reflection, s.wi), draw.technique, s,
                                 techniques_pdf(techniques, s.wi));
            else
                result = reflect_sample(estimate.reflection, s);
            modulate(light, result);
            add_sample(estimate, result);
        }
    }
    estimate.radiance += (1.0 / float(frame.light_samples) * light.role.emission) * estimate.sum.sum;
}
