#ifndef NUSSELT_EMISSION_TEXTURED_POLYGON_GLSL
#define NUSSELT_EMISSION_TEXTURED_POLYGON_GLSL
// Follows include/nusselt/emission/textured_polygon.h @ 9805b2e0f56e
/// Sampling of polygons with a texture in proportion to radiance times the cosine at the surface. Twin of
/// include/nusselt/emission/textured_polygon.h, with 8 x 8 cells and DescentByProduct.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space; the shading point is the origin, the normal +z.
/// Edge cases: nothing of the light above the horizon, black light, no area, origin in the plane of the light: pdf = 0,
/// measure 0. A texel that the horizon cuts may give a sample with pdf = 0.

#include "../emission/textured_cells.glsl"
#include "../sampling/polygon_projected_solid_angle.glsl"

struct TexturedPolygon {
    TexturedCells cells;
};

/// See textured_polygon_prepare().
TexturedView textured_polygon_view(const TexturePlane plane, uint light) {
    TexturedView view = textured_view_prepare(plane, light);
    view.distance = abs(plane_distance(texture_plane_outline(view.plane)));
    return view;
}

/// \param plane of the texture in shading space [m].
/// \param light number of the first word of the light (textured_light.glsl).
TexturedPolygon textured_polygon_prepare(const TexturePlane plane, uint light) {
    return TexturedPolygon(textured_cells_prepare(textured_polygon_view(plane, light)));
}

/// The sum over cells of mean radiance, averaged over channels, times projected solid angle [W/m^2].
float textured_polygon_measure(const TexturedPolygon self) { return self.cells.sums.total; }

/// The radiance that is reflected without shadows per albedo, per channel [W/(sr m^2)]: the coefficient of heuristics
/// for multiple importance sampling. Exact where the texture is constant in each cell.
vec3 textured_polygon_unshadowed(const TexturedPolygon self) { return textured_cells_unshadowed(self.cells); }

/// The technique inside of a smooth cell.
PolygonProjectedSolidAngle textured_polygon_technique(const TexturedView view, const TexturedSpot spot) {
    return polygon_projected_solid_angle_prepare(polygon_in(view.plane, spot.part));
}

/// \param u in [0, 1)^2; x chooses along the x axis of the texture, y along its y axis: stratification survives in
///          part.
TexturedSample textured_polygon_sample(const TexturedPolygon self, vec2 u) {
    if (!(self.cells.sums.total > 0.0)) return no_textured_sample();
    TexturedView view = self.cells.view;
    TexturedSpot spot = textured_cells_spot_of(self.cells, u);
    if (!spot.is_smooth) return textured_view_busy_sample(view, spot);
    return textured_view_smooth_sample(
        view, spot, polygon_projected_solid_angle_sample(textured_polygon_technique(view, spot), spot.cell.u));
}

/// \param wi a unit direction towards the light.
/// \param at texture coordinates of the point there.
float textured_polygon_density(const TexturedPolygon self, vec3 wi, vec2 at) {
    TexturedView view = self.cells.view;
    TexturedSpot spot = textured_cells_spot_at(self.cells, at);
    if (!(spot.cell.probability > 0.0)) return 0.0;
    if (!spot.is_smooth) return textured_view_busy_density(view, spot, wi, at);
    return spot.cell.probability * polygon_projected_solid_angle_pdf(textured_polygon_technique(view, spot), wi);
}

/// \param wi a unit direction towards the light.
float textured_polygon_pdf(const TexturedPolygon self, vec3 wi) {
    if (!(self.cells.sums.total > 0.0)) return 0.0;
    return textured_polygon_density(self, wi, textured_view_hit(self.cells.view, wi));
}

/// The density of the direction to the point with these texture coordinates [1/sr].
float textured_polygon_pdf_at(const TexturedPolygon self, vec2 at) {
    if (!(self.cells.sums.total > 0.0)) return 0.0;
    return textured_polygon_density(self, nusselt_normalize(texture_plane_point_at(self.cells.view.plane, at)), at);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 textured_polygon_invert(const TexturedPolygon self, vec3 wi) {
    if (!(self.cells.sums.total > 0.0)) return vec2(0.0);
    TexturedView view = self.cells.view;
    vec2 at = textured_view_hit(view, wi);
    TexturedSpot spot = textured_cells_spot_at(self.cells, at);
    vec2 u;
    if (spot.is_smooth) {
        u = polygon_projected_solid_angle_invert(textured_polygon_technique(view, spot), wi);
    } else {
        u = textured_view_busy_invert(view, spot, at);
    }
    return cell_choice_united(spot.cell, u);
}

#endif
