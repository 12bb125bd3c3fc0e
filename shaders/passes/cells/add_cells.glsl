/// Adds samples of one light whose radiance varies, in proportion to radiance times a measure, as
/// src/render_cpu/kernel/lights/cell_samples.h does. A file includes this one for each kind of such lights, with the type
///
///     CELLS: the techniques of a light as a shading point sees it, number 0 for the diffuse component or for all, number 1 for
///         the specular one. Its functions have the same names for all kinds:
///         TexturedSample cells_sample(cells, technique, u);
///         float cells_pdf(cells, technique, s): the density of a technique at a sample of the other one;
///         vec3 cells_unshadowed(cells, technique): the coefficients of heuristics per albedo;
///         vec3 cells_radiance(cells, at): what the light emits there [W/(sr m^2)];
///         vec3 cells_point(cells, s): where the shadow ray of a sample ends, in shading space [m].

/// \param number    of the light
/// \param is_paired whether there is a technique 1
/// \param emission  a factor of what the light emits
void add_cells(inout Estimate estimate, uint number, const CELLS cells, bool is_paired, vec3 emission) {
    estimate.sum = CompensatedSum(vec3(0.0), vec3(0.0));
    TechniquePair pair;
    if (is_paired)
        pair = make_technique_pair(estimate.reflection.glossy, cells_unshadowed(cells, 0), cells_unshadowed(cells, 1));
    for (uint i = frame.first_sample; i < frame.sample_end; ++i) {
        for (int k = 0; k < samples_per_number(is_paired); ++k) {
            vec2 u = random_for_light(estimate.pixel, i, number, k);
            Draw draw = choose_technique(is_paired, pair, k, u);
            TexturedSample textured = cells_sample(cells, draw.technique, draw.u);
            LightSample s = LightSample(textured.wi, textured.pdf, cells_point(cells, textured));
            vec3 radiance = cells_radiance(cells, textured.at);
            DirectLightSample result;
            if (is_paired) {
                float other = s.pdf != 0.0 ? cells_pdf(cells, 1 - draw.technique, textured) : 0.0;
                BrdfComponents reflected = reflection_eval_components(estimate.reflection, s.wi);
                result = combine(pair, BrdfComponents(radiance * reflected.diffuse, radiance * reflected.specular),
                                 draw.technique, s, draw.technique == 0 ? vec2(s.pdf, other) : vec2(other, s.pdf));
            } else {
                result = reflect_sample(estimate.reflection, s);
                result.shadowed = radiance * result.shadowed;
            }
            add_sample(estimate, result);
        }
    }
    estimate.radiance += (1.0 / float(frame.light_samples) * emission) * estimate.sum.sum;
}
