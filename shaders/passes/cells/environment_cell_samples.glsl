#ifndef NUSSELT_PASSES_CELLS_ENVIRONMENT_CELL_SAMPLES_GLSL
#define NUSSELT_PASSES_CELLS_ENVIRONMENT_CELL_SAMPLES_GLSL
/// Samples of environments without a portal. There is one way for all settings: radiance times a measure.

#include "passes/cells/environment_cells.glsl"
#include "passes/lights/techniques.glsl"

vec3 sample_cosine(vec2 u) {
    bool is_second = u.y >= 0.5;
    SinCos angle = sincos_half_turn((2.0 * kNusseltPi) * (u.y - (is_second ? 0.5 : 0.0)));
    float radius = is_second ? -sqrt(u.x) : sqrt(u.x);
    return vec3(radius * angle.cosine, radius * angle.sine, sqrt(nusselt_max(1.0 - u.x, 0.0)));
}

/// The density of the cosine, or of the lobe, also below the horizon.
float measure_pdf(const Sky sky, int technique, vec3 wi) {
    return technique == 1 ? ltc_density(sky.lobe, wi) : (1.0 / kNusseltPi) * nusselt_max(wi.z, 0.0);
}

TexturedSample measure_sample(const Sky sky, int technique, vec2 u) {
    vec3 wi = sample_cosine(u);
    if (technique == 1) wi = nusselt_normalize(ltc_to_shading(sky.lobe, wi));
    return TexturedSample(wi, measure_pdf(sky, technique, wi), wi, vec2(0.0));
}

/// What the techniques share, without sums.
EnvironmentCells seen_map(const Sky sky, int technique) {
    return environment_cells_prepare(sky.map, sky.diffuse.frame, technique == 1 ? sky.specular.lowest : sky.diffuse.lowest);
}

float sky_total(const Sky sky, int technique) {
    return technique == 1 ? sky.specular.sums.total : sky.diffuse.sums.total;
}

/// The weights of the parts of an element.
vec4 sky_weights(const Sky sky, int technique, int level, ivec2 at) {
    if (level == 1) return environment_map_texel_weights(sky.map, at);
    EnvironmentElements four = environment_map_parts(sky.map, level, at);
    return four.weight * (technique == 1 ? environment_ltc_factor(sky.lobe_on_map, four)
                                         : environment_cosine_factor(sky.diffuse.frame.n, four));
}

// As environment_cosine_sample() and environment_ltc_sample().
TexturedSample cells_sample(const Sky sky, int technique, vec2 u) {
    if (!has_map(sky)) return measure_sample(sky, technique, u);
    if (!(sky_total(sky, technique) > 0.0)) return no_textured_sample();
    CellChoice cell;
    if (technique == 1)
        cell = cell_sums_choose(sky.specular.sums, u);
    else
        cell = cell_sums_choose(sky.diffuse.sums, u);
    TexelChoice texel = TexelChoice(cell.at, 1.0, cell.u);
    for (int level = environment_map_levels(sky.map) - 1; level > 0; --level)
        descend_to_part(texel, sky_weights(sky, technique, level, texel.at), ivec2(2));
    return environment_cells_sample(seen_map(sky, technique), cell, texel);
}

// As environment_cosine_density() and environment_ltc_density().
float cells_pdf(const Sky sky, int technique, const TexturedSample s) {
    if (!has_map(sky)) return measure_pdf(sky, technique, s.wi);
    if (!(sky_total(sky, technique) > 0.0)) return 0.0;
    EnvironmentCells seen = seen_map(sky, technique);
    TexelChoice texel = environment_cells_texel_at(seen, s.at);
    TexelChoice choice = texel;
    int levels = environment_map_levels(sky.map);
    for (int level = 1; level < levels; ++level) {
        ivec2 part = choice.at & 1;
        choice.at = choice.at >> 1;
        ascend_from_part(choice, part, sky_weights(sky, technique, level, choice.at));
    }
    float of_cell;
    if (technique == 1)
        of_cell = cell_sums_at(sky.specular.sums, s.at).probability;
    else
        of_cell = cell_sums_at(sky.diffuse.sums, s.at).probability;
    return environment_cells_density(seen, of_cell * choice.probability, texel.at,
                                     environment_map_interpolant(sky.map, texel.at), s.at, s.wi);
}

/// Of uniform radiance, 1: it is a factor of all samples.
vec3 cells_radiance(const Sky sky, vec2 at) { return has_map(sky) ? environment_map_lookup(sky.map, at) : vec3(1.0); }

/// Beyond the scene, from any of its points.
vec3 cells_point(const Sky sky, const TexturedSample s) { return (4.0 * scene.radius) * s.wi; }

#define CELLS Sky
#include "passes/cells/add_cells.glsl"
#undef CELLS

void add_environments(inout Estimate estimate) {
    GlossySurface glossy = estimate.reflection.glossy;
    bool is_paired = kStrategies == kStrategiesDiffuseLtc && glossy_surface_is_glossy(glossy);
    for (uint i = first_index(kEnvironmentKind); kHasSkies && i < end_index(kEnvironmentKind); ++i) {
        if (has_portal(i)) continue;
        Sky sky = prepare_sky(i, estimate.surface.shading, glossy.lobe, is_paired);
        vec3 emission = has_map(sky) ? vec3(1.0) : to_vec(environment_lights[i].radiance);
        add_cells(estimate, light_number(kEnvironmentKind, i), sky, is_paired, emission);
    }
}

#endif
