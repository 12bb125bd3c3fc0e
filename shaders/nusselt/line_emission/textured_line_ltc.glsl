#ifndef NUSSELT_LINE_EMISSION_TEXTURED_LINE_LTC_GLSL
#define NUSSELT_LINE_EMISSION_TEXTURED_LINE_LTC_GLSL
// Follows include/nusselt/line_emission/textured_line.h @ b972ffb2caa5
/// Sampling of linear lights whose radiance varies along them, in proportion to radiance times a glossy lobe. Twin of
/// TexturedLineLtc in include/nusselt/line_emission/textured_line.h, for profiles of up to 64 texels.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr].
/// Space: shading space with wo in the xz half-plane (shading_frame()). Samples are not below the surface.
/// Edge cases: nothing of the light in the lobe above the horizon, black light, no length, or origin on the infinite line up to
/// rounding: pdf = 0, measure 0. Black parts are never sampled.

#include "../line_emission/line_cells.glsl"
#include "../sampling/line_ltc.glsl"

struct TexturedLineLtc {
    LineCells cells;
    Ltc ltc;
};

/// Integrals of the lobe over parts of a line, over projected solid angles of their images.
/// \param line with coordinates of order one.
float textured_line_ltc_ratio(const LineSegment line, const Ltc ltc) {
    float thicker = kNusseltPi * radius_ratio(nusselt_cross(line.p0, line.s), ltc);
    float ratio = 1.0 / (thicker > 0.0 ? thicker : 1.0);
    return thicker > 0.0 && is_finite(ratio) && centered(line).len > 0.0 ? ratio : 0.0;
}

/// \param light   in shading space [m].
/// \param profile number of its first word (line_profile.glsl).
TexturedLineLtc textured_line_ltc_prepare(const LineSegment light, uint profile, const Ltc ltc) {
    float scale = scale_of(light);
    LineSegment line = scaled(light, scale);
    return TexturedLineLtc(line_cells_prepare(line, to_cosine_space(line, ltc), textured_line_ltc_ratio(line, ltc),
                                              scale, profile),
                           ltc);
}

/// The technique in a cell.
LineLtc textured_line_ltc_technique(const TexturedLineLtc self, const LineCell cell) {
    return line_clipped_ltc_prepare(cell.part, self.ltc);
}

/// The sum over cells of mean radiance, averaged over channels, times the integral of the lobe per radius [W/(sr m^3)].
float textured_line_ltc_measure(const TexturedLineLtc self) { return self.cells.total; }

/// See textured_line_unshadowed().
vec3 textured_line_ltc_unshadowed(const TexturedLineLtc self) { return self.cells.expected; }

/// \param u in [0, 1); increasing u moves from the start of the light to its end. The sample is at a share of the length,
///          `at.x`.
TexturedSample textured_line_ltc_sample(const TexturedLineLtc self, float u) {
    if (!(self.cells.total > 0.0)) return no_textured_sample();
    LineSpot spot = line_cells_spot_of(self.cells, u);
    LineLtc technique = textured_line_ltc_technique(self, spot.cell);
    return line_cells_sample(self.cells, spot, line_ltc_sample(technique, spot.x), line_ltc_measure(technique));
}

/// The density of a direction. \param at share of the length before the point there.
float textured_line_ltc_density(const TexturedLineLtc self, vec3 wi, float at) {
    LineCell cell = line_cells_cell(self.cells, line_cells_cell_at(self.cells, at));
    if (wi.z < 0.0) return 0.0;
    LineLtc technique = textured_line_ltc_technique(self, cell);
    return line_cells_density(self.cells, cell, line_ltc_invert(technique, wi),
                              line_ltc_measure(technique) * line_ltc_pdf(technique, wi));
}

/// \param wi a unit direction towards the light.
float textured_line_ltc_pdf(const TexturedLineLtc self, vec3 wi) {
    if (!(self.cells.total > 0.0)) return 0.0;
    return textured_line_ltc_density(self, wi, line_cells_position_of(self.cells, wi));
}

/// The density of the direction to a point of the light [m/sr]. \param at share of the length before it, in [0, 1].
float textured_line_ltc_pdf_at(const TexturedLineLtc self, float at) {
    if (!(self.cells.total > 0.0)) return 0.0;
    return textured_line_ltc_density(self, nusselt_normalize(line_cells_point_at(self.cells, at)), at);
}

/// The random number for which the sample is wi, a unit direction on the light.
float textured_line_ltc_invert(const TexturedLineLtc self, vec3 wi) {
    if (!(self.cells.total > 0.0)) return 0.0;
    int k = line_cells_cell_at(self.cells, line_cells_position_of(self.cells, wi));
    LineCell cell = line_cells_cell(self.cells, k);
    return line_cells_united(self.cells, line_cells_sums(self.cells, kNusseltLargest, k), cell, line_ltc_invert(textured_line_ltc_technique(self, cell), wi));
}

#endif
