#ifndef NUSSELT_EMISSION_ENVIRONMENT_LTC_GLSL
#define NUSSELT_EMISSION_ENVIRONMENT_LTC_GLSL
// Follows include/nusselt/emission/environment_sampling.h @ 5ca2cddb10f4
/// Sampling of environment maps in proportion to radiance times a glossy lobe. Twin of EnvironmentLtc in
/// include/nusselt/emission/environment_sampling.h, with 8 x 8 cells.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space with wo in the xz half-plane (shading_frame()). Samples may lie below the surface, wi.z < 0:
/// they count, with a contribution of zero.
/// Edge cases: black maps: pdf = 0, measure 0. Each direction that the map lights has a positive density, unless its
/// radiance is below 1e-38 of the largest.

#include "../emission/environment_cells.glsl"
#include "../emission/smooth_clamp.glsl"
#include "../ltc/ltc.glsl"

/// The density of a lobe for directions in the space of the map.
struct EnvironmentLobe {
    vec3 column_x, column_y, column_z; ///< cosine_from_map, scaled like the matrix of the lobe
    float height_spread;               ///< squared norm of its last row
    float spread;                      ///< squared norm of all of it
    float growth;                      ///< of the area of the lobe per variance
    float minor, lateral;              ///< their product is its determinant over pi
};

struct EnvironmentLtc {
    EnvironmentCells cells;
    EnvironmentLobe lobe;
};

/// \param frame of the shading point, in the space of the map.
EnvironmentLobe environment_lobe_prepare(const Ltc ltc, const Frame frame) {
    EnvironmentLobe self;
    self.column_x = ltc_to_cosine(ltc, vec3(frame.t.x, frame.b.x, frame.n.x));
    self.column_y = ltc_to_cosine(ltc, vec3(frame.t.y, frame.b.y, frame.n.y));
    self.column_z = ltc_to_cosine(ltc, vec3(frame.t.z, frame.b.z, frame.n.z));
    vec3 height = vec3(self.column_x.z, self.column_y.z, self.column_z.z);
    self.height_spread = dot(height, height);
    self.minor = ltc.minor;
    // In the plane of the normal and wo, the matrix has two columns. Across, it has one number.
    float across = ltc.m11;
    self.lateral = across * (1.0 / kNusseltPi);
    float in_plane = (ltc.m00 * ltc.m00 + ltc.m20 * ltc.m20) + (ltc.m02 * ltc.m02 + ltc.m22 * ltc.m22);
    self.spread = in_plane + across * across;
    // The squared length of the shortest image of a unit vector, where the density is largest.
    float root = sqrt(nusselt_max(in_plane * in_plane - 4.0 * self.minor * self.minor, 0.0));
    float shortest = nusselt_min(2.0 * self.minor * self.minor / (in_plane + root), across * across);
    self.growth = nusselt_max(self.spread / nusselt_max(shortest, kNusseltTiny) - 3.0, 0.0);
    return self;
}

/// About the mean densities in four elements: those in the mean directions, widened by the variance, with the same
/// integral. The area of a narrow lobe grows with the variance, and a Lambertian lobe remains.
vec4 environment_ltc_factor(const EnvironmentLobe self, const EnvironmentElements four) {
    vec4 x = self.column_x.x * four.x + (self.column_y.x * four.y + self.column_z.x * four.z);
    vec4 y = self.column_x.y * four.x + (self.column_y.y * four.y + self.column_z.y * four.z);
    vec4 z = self.column_x.z * four.x + (self.column_y.z * four.y + self.column_z.z * four.z);
    vec4 inverse = 1.0 / (four.variance * self.spread + (x * x + y * y + z * z));
    vec4 height = smooth_clamp(z, self.height_spread * four.variance) * (four.variance * self.growth + 1.0);
    // Each factor is in the range of float, also for narrow lobes.
    return (self.minor * inverse) * (self.lateral * (height * inverse));
}

/// \param map   number of its first word (environment_map.glsl).
/// \param frame of the shading point, in the space of the map.
EnvironmentLtc environment_ltc_prepare(uint map, const Frame frame, const Ltc ltc) {
    EnvironmentLobe lobe = environment_lobe_prepare(ltc, frame);
    EnvironmentCells cells = environment_cells_prepare(map, frame, -kNusseltLargest);
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; cell += 4) {
        EnvironmentElements four = environment_map_cells(map, cell);
        environment_cells_add(cells, cell, four.weight, environment_ltc_factor(lobe, four));
    }
    environment_cells_finish(cells, 1.0);
    return EnvironmentLtc(cells, lobe);
}

/// An estimate of the integral of radiance, averaged over channels, times the density of the lobe [W/(sr m^2)].
float environment_ltc_measure(const EnvironmentLtc self) { return environment_cells_measure(self.cells); }

/// See environment_cosine_unshadowed().
vec3 environment_ltc_unshadowed(const EnvironmentLtc self) {
    return self.cells.unshadowed;
}

/// The weights of the parts of an element. Neighbouring texels have nearly the same density.
vec4 environment_ltc_weights(const EnvironmentLtc self, int level, ivec2 at) {
    if (level == 1) return environment_map_texel_weights(self.cells.map, at);
    EnvironmentElements four = environment_map_parts(self.cells.map, level, at);
    return four.weight * environment_ltc_factor(self.lobe, four);
}

/// The probability of a texel given its cell, and the random numbers that lead there.
/// \param choice with the texel, and with the random numbers inside of it.
TexelChoice environment_ltc_ascend(const EnvironmentLtc self, TexelChoice choice) {
    int levels = environment_map_levels(self.cells.map);
    for (int level = 1; level < levels; ++level) {
        ivec2 part = choice.at & 1;
        choice.at = choice.at >> 1;
        ascend_from_part(choice, part, environment_ltc_weights(self, level, choice.at));
    }
    return choice;
}

/// \param u in [0, 1)^2; see environment_cosine_sample().
TexturedSample environment_ltc_sample(const EnvironmentLtc self, vec2 u) {
    if (!(self.cells.sums.total > 0.0)) return no_textured_sample();
    CellChoice cell = cell_sums_choose(self.cells.sums, u);
    TexelChoice texel = TexelChoice(cell.at, 1.0, cell.u);
    for (int level = environment_map_levels(self.cells.map) - 1; level > 0; --level)
        descend_to_part(texel, environment_ltc_weights(self, level, texel.at), ivec2(2));
    return environment_cells_sample(self.cells, cell, texel);
}

/// \param at point of the map.
/// \param wi its direction.
float environment_ltc_density(const EnvironmentLtc self, vec2 at, vec3 wi) {
    if (!(self.cells.sums.total > 0.0)) return 0.0;
    TexelChoice texel = environment_cells_texel_at(self.cells, at);
    float of_cell = cell_sums_at(self.cells.sums, at).probability;
    float in_cell = environment_ltc_ascend(self, texel).probability;
    return environment_cells_density(self.cells, of_cell * in_cell, texel.at,
                                     environment_map_interpolant(self.cells.map, texel.at), at, wi);
}

/// \param wi unit.
float environment_ltc_pdf(const EnvironmentLtc self, vec3 wi) {
    return environment_ltc_density(self, octahedral_coordinates(frame_to_world(self.cells.frame, wi)), wi);
}

/// The density of the direction of a point of the map [1/sr].
/// \param at in [0, 1)^2.
float environment_ltc_pdf_at(const EnvironmentLtc self, vec2 at) {
    return environment_ltc_density(self, at, frame_to_local(self.cells.frame, octahedral_direction(at)));
}

/// The random numbers for which the sample is wi, a unit direction.
vec2 environment_ltc_invert(const EnvironmentLtc self, vec3 wi) {
    if (!(self.cells.sums.total > 0.0)) return vec2(0.0);
    vec2 at = octahedral_coordinates(frame_to_world(self.cells.frame, wi));
    TexelChoice texel = environment_cells_texel_at(self.cells, at);
    texel.u = bilinear_texel_invert(environment_map_interpolant(self.cells.map, texel.at),
                                    environment_cells_inside(self.cells, texel.at, at));
    return cell_choice_united(cell_sums_at(self.cells.sums, at), environment_ltc_ascend(self, texel).u);
}

#endif
