#ifndef NUSSELT_EMISSION_ENVIRONMENT_COSINE_GLSL
#define NUSSELT_EMISSION_ENVIRONMENT_COSINE_GLSL
// Follows include/nusselt/emission/environment_sampling.h @ 5ca2cddb10f4
/// Sampling of environment maps in proportion to radiance times the cosine at the surface. Twin of EnvironmentCosine in
/// include/nusselt/emission/environment_sampling.h, with 8 x 8 cells.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space; the normal is +z.
/// Edge cases: black maps: pdf = 0, measure 0. Each direction that the map lights above the horizon has a positive
/// density, unless its radiance is below 1e-38 of the largest. Few samples end below the horizon, with pdf = 0.

#include "../emission/environment_cells.glsl"
#include "../emission/smooth_clamp.glsl"

struct EnvironmentCosine {
    EnvironmentCells cells;
};

/// About the mean cosines of four elements.
vec4 environment_cosine_factor(vec3 normal, const EnvironmentElements four) {
    return smooth_clamp(normal.x * four.x + normal.y * four.y + normal.z * four.z, four.variance);
}

/// \param map   number of its first word (environment_map.glsl).
/// \param frame of the shading point, in the space of the map.
EnvironmentCosine environment_cosine_prepare(uint map, const Frame frame) {
    EnvironmentCells cells = environment_cells_prepare(map, frame, 0.0);
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; cell += 4) {
        EnvironmentElements four = environment_map_cells(map, cell);
        environment_cells_add(cells, cell, four.weight, environment_cosine_factor(frame.n, four));
    }
    environment_cells_finish(cells, 1.0 / kNusseltPi);
    return EnvironmentCosine(cells);
}

/// An estimate of the integral of radiance, averaged over channels, times the cosine [W/m^2].
float environment_cosine_measure(const EnvironmentCosine self) { return environment_cells_measure(self.cells); }

/// The radiance that is reflected without shadows per albedo, per channel [W/(sr m^2)]: the coefficient of heuristics
/// for multiple importance sampling, an estimate as the measure.
vec3 environment_cosine_unshadowed(const EnvironmentCosine self) {
    return self.cells.unshadowed;
}

/// The weights of the parts of an element. Neighbouring texels have nearly the same cosine.
vec4 environment_cosine_weights(const EnvironmentCosine self, int level, ivec2 at) {
    if (level == 1) return environment_map_texel_weights(self.cells.map, at);
    EnvironmentElements four = environment_map_parts(self.cells.map, level, at);
    return four.weight * environment_cosine_factor(self.cells.frame.n, four);
}

/// The probability of a texel given its cell, and the random numbers that lead there.
/// \param choice with the texel, and with the random numbers inside of it.
TexelChoice environment_cosine_ascend(const EnvironmentCosine self, TexelChoice choice) {
    int levels = environment_map_levels(self.cells.map);
    for (int level = 1; level < levels; ++level) {
        ivec2 part = choice.at & 1;
        choice.at = choice.at >> 1;
        ascend_from_part(choice, part, environment_cosine_weights(self, level, choice.at));
    }
    return choice;
}

/// \param u in [0, 1)^2; x chooses along the x axis of the map, y along its y axis: some stratification survives.
/// \return p is wi times kNusseltEnvironmentDistance, `at` the point of the map: look up the radiance there.
TexturedSample environment_cosine_sample(const EnvironmentCosine self, vec2 u) {
    if (!(self.cells.sums.total > 0.0)) return no_textured_sample();
    CellChoice cell = cell_sums_choose(self.cells.sums, u);
    TexelChoice texel = TexelChoice(cell.at, 1.0, cell.u);
    for (int level = environment_map_levels(self.cells.map) - 1; level > 0; --level)
        descend_to_part(texel, environment_cosine_weights(self, level, texel.at), ivec2(2));
    return environment_cells_sample(self.cells, cell, texel);
}

/// \param at point of the map.
/// \param wi its direction.
float environment_cosine_density(const EnvironmentCosine self, vec2 at, vec3 wi) {
    if (!(self.cells.sums.total > 0.0)) return 0.0;
    TexelChoice texel = environment_cells_texel_at(self.cells, at);
    float of_cell = cell_sums_at(self.cells.sums, at).probability;
    float in_cell = environment_cosine_ascend(self, texel).probability;
    return environment_cells_density(self.cells, of_cell * in_cell, texel.at,
                                     environment_map_interpolant(self.cells.map, texel.at), at, wi);
}

/// \param wi unit.
float environment_cosine_pdf(const EnvironmentCosine self, vec3 wi) {
    return environment_cosine_density(self, octahedral_coordinates(frame_to_world(self.cells.frame, wi)), wi);
}

/// The density of the direction of a point of the map [1/sr].
/// \param at in [0, 1)^2.
float environment_cosine_pdf_at(const EnvironmentCosine self, vec2 at) {
    return environment_cosine_density(self, at, frame_to_local(self.cells.frame, octahedral_direction(at)));
}

/// The random numbers for which the sample is wi, a unit direction.
vec2 environment_cosine_invert(const EnvironmentCosine self, vec3 wi) {
    if (!(self.cells.sums.total > 0.0)) return vec2(0.0);
    vec2 at = octahedral_coordinates(frame_to_world(self.cells.frame, wi));
    TexelChoice texel = environment_cells_texel_at(self.cells, at);
    texel.u = bilinear_texel_invert(environment_map_interpolant(self.cells.map, texel.at),
                                    environment_cells_inside(self.cells, texel.at, at));
    return cell_choice_united(cell_sums_at(self.cells.sums, at), environment_cosine_ascend(self, texel).u);
}

#endif
