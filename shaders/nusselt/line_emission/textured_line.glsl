#ifndef NUSSELT_LINE_EMISSION_TEXTURED_LINE_GLSL
#define NUSSELT_LINE_EMISSION_TEXTURED_LINE_GLSL
// Follows include/nusselt/line_emission/textured_line.h @ b972ffb2caa5
/// Sampling of linear lights whose radiance varies along them, in proportion to radiance times the cosine at the surface. Twin of
/// TexturedLine in include/nusselt/line_emission/textured_line.h, for profiles of up to 64 texels.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr].
/// Space: shading space; the shading point is the origin, the normal +z.
/// Edge cases: nothing of the light above the horizon, black light, no length, or origin on the infinite line up to rounding:
/// pdf = 0, measure 0. Black parts are never sampled.

#include "../line_emission/line_cells.glsl"
#include "../sampling/line_projected_solid_angle.glsl"

struct TexturedLine {
    LineCells cells;
};

/// \param light   in shading space [m].
/// \param profile number of its first word (line_profile.glsl).
TexturedLine textured_line_prepare(const LineSegment light, uint profile) {
    float scale = scale_of(light);
    LineSegment line = scaled(light, scale);
    return TexturedLine(line_cells_prepare(line, line, 1.0, scale, profile));
}

/// The technique in a cell.
LineProjectedSolidAngle textured_line_technique(const TexturedLine self, const LineCell cell) {
    return line_projected_solid_angle_prepare(cell.part);
}

/// The sum over cells of mean radiance, averaged over channels, times projected solid angle per radius [W/m^3].
float textured_line_measure(const TexturedLine self) { return self.cells.total; }

/// The light that is reflected without shadows per radius and albedo, per channel [W/(sr m^3)]: the coefficient of heuristics
/// for multiple importance sampling. Exact where the light is constant.
vec3 textured_line_unshadowed(const TexturedLine self) { return (1.0 / kNusseltPi) * self.cells.expected; }

/// \param u in [0, 1); increasing u moves from the start of the light to its end. The sample is at a share of the length,
///          `at.x`.
TexturedSample textured_line_sample(const TexturedLine self, float u) {
    if (!(self.cells.total > 0.0)) return no_textured_sample();
    LineSpot spot = line_cells_spot_of(self.cells, u);
    LineProjectedSolidAngle technique = textured_line_technique(self, spot.cell);
    return line_cells_sample(self.cells, spot, line_projected_solid_angle_sample(technique, spot.x), line_projected_solid_angle_measure(technique));
}

/// The density of a direction. \param at share of the length before the point there.
float textured_line_density(const TexturedLine self, vec3 wi, float at) {
    LineCell cell = line_cells_cell(self.cells, line_cells_cell_at(self.cells, at));
    if (wi.z < 0.0) return 0.0;
    LineProjectedSolidAngle technique = textured_line_technique(self, cell);
    return line_cells_density(self.cells, cell, line_projected_solid_angle_invert(technique, wi),
                              line_projected_solid_angle_measure(technique) * line_projected_solid_angle_pdf(technique, wi));
}

/// \param wi a unit direction towards the light.
float textured_line_pdf(const TexturedLine self, vec3 wi) {
    if (!(self.cells.total > 0.0)) return 0.0;
    return textured_line_density(self, wi, line_cells_position_of(self.cells, wi));
}

/// The density of the direction to a point of the light [m/sr]. \param at share of the length before it, in [0, 1].
float textured_line_pdf_at(const TexturedLine self, float at) {
    if (!(self.cells.total > 0.0)) return 0.0;
    return textured_line_density(self, nusselt_normalize(line_cells_point_at(self.cells, at)), at);
}

/// The random number for which the sample is wi, a unit direction on the light.
float textured_line_invert(const TexturedLine self, vec3 wi) {
    if (!(self.cells.total > 0.0)) return 0.0;
    int k = line_cells_cell_at(self.cells, line_cells_position_of(self.cells, wi));
    LineCell cell = line_cells_cell(self.cells, k);
    return line_cells_united(self.cells, line_cells_sums(self.cells, kNusseltLargest, k), cell, line_projected_solid_angle_invert(textured_line_technique(self, cell), wi));
}

#endif
