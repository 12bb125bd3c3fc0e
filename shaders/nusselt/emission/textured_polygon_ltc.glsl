#ifndef NUSSELT_EMISSION_TEXTURED_POLYGON_LTC_GLSL
#define NUSSELT_EMISSION_TEXTURED_POLYGON_LTC_GLSL
// Follows include/nusselt/emission/textured_polygon.h @ 9805b2e0f56e
/// Sampling of polygons with a texture in proportion to radiance times a glossy lobe. Twin of TexturedPolygonLtc in
/// include/nusselt/emission/textured_polygon.h, with 8 x 8 cells and DescentByProduct.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space with wo in the xz half-plane (shading_frame()). Samples may lie below the surface, wi.z < 0:
/// they count, with a contribution of zero.
/// Edge cases: nothing of the light in the lobe, black light, no area, origin in the plane of the light: pdf = 0,
/// measure 0.

#include "../emission/textured_cells.glsl"
#include "../sampling/polygon_ltc.glsl"

struct TexturedPolygonLtc {
    TexturedCells cells;
    Ltc ltc;
};

/// See textured_polygon_ltc_prepare().
TexturedView textured_polygon_ltc_view(const TexturePlane plane, uint light, const Ltc ltc) {
    TexturedView view = textured_view_prepare(plane, light);
    view.image = TexturePlane(ltc_to_cosine(ltc, view.plane.corner), ltc_to_cosine(ltc, view.plane.side_x),
                              ltc_to_cosine(ltc, view.plane.side_y),
                              nusselt_normalize(ltc_normal_to_cosine(ltc, view.plane.normal)));
    view.image_area = texture_plane_area(view.image);
    view.distance = abs(plane_distance(texture_plane_outline(view.plane)));
    view.lowest = -kNusseltLargest;
    return view;
}

/// \param plane of the texture in shading space [m].
/// \param light number of the first word of the light (textured_light.glsl).
TexturedPolygonLtc textured_polygon_ltc_prepare(const TexturePlane plane, uint light, const Ltc ltc) {
    return TexturedPolygonLtc(textured_cells_prepare(textured_polygon_ltc_view(plane, light, ltc)), ltc);
}

/// The sum over cells of mean radiance, averaged over channels, times the integral of the lobe [W/(sr m^2)].
float textured_polygon_ltc_measure(const TexturedPolygonLtc self) { return (1.0 / kNusseltPi) * self.cells.sums.total; }

/// See textured_polygon_unshadowed().
vec3 textured_polygon_ltc_unshadowed(const TexturedPolygonLtc self) { return textured_cells_unshadowed(self.cells); }

/// The technique inside of a smooth cell.
PolygonLtc textured_polygon_ltc_technique(const TexturedPolygonLtc self, const TexturedSpot spot) {
    return polygon_ltc_prepare(polygon_in(self.cells.view.plane, spot.part), self.ltc);
}

/// \param u in [0, 1)^2; see textured_polygon_sample().
TexturedSample textured_polygon_ltc_sample(const TexturedPolygonLtc self, vec2 u) {
    if (!(self.cells.sums.total > 0.0)) return no_textured_sample();
    TexturedView view = self.cells.view;
    TexturedSpot spot = textured_cells_spot_of(self.cells, u);
    if (!spot.is_smooth) return textured_view_busy_sample(view, spot);
    return textured_view_smooth_sample(view, spot,
                                       polygon_ltc_sample(textured_polygon_ltc_technique(self, spot), spot.cell.u));
}

/// \param wi a unit direction towards the light.
/// \param at texture coordinates of the point there.
float textured_polygon_ltc_density(const TexturedPolygonLtc self, vec3 wi, vec2 at) {
    TexturedView view = self.cells.view;
    TexturedSpot spot = textured_cells_spot_at(self.cells, at);
    if (!(spot.cell.probability > 0.0)) return 0.0;
    if (!spot.is_smooth) return textured_view_busy_density(view, spot, wi, at);
    return spot.cell.probability * polygon_ltc_pdf(textured_polygon_ltc_technique(self, spot), wi);
}

/// \param wi a unit direction towards the light.
float textured_polygon_ltc_pdf(const TexturedPolygonLtc self, vec3 wi) {
    if (!(self.cells.sums.total > 0.0)) return 0.0;
    return textured_polygon_ltc_density(self, wi, textured_view_hit(self.cells.view, wi));
}

/// The density of the direction to the point with these texture coordinates [1/sr].
float textured_polygon_ltc_pdf_at(const TexturedPolygonLtc self, vec2 at) {
    if (!(self.cells.sums.total > 0.0)) return 0.0;
    return textured_polygon_ltc_density(self, nusselt_normalize(texture_plane_point_at(self.cells.view.plane, at)), at);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 textured_polygon_ltc_invert(const TexturedPolygonLtc self, vec3 wi) {
    if (!(self.cells.sums.total > 0.0)) return vec2(0.0);
    TexturedView view = self.cells.view;
    vec2 at = textured_view_hit(view, wi);
    TexturedSpot spot = textured_cells_spot_at(self.cells, at);
    vec2 u;
    if (spot.is_smooth) {
        u = polygon_ltc_invert(textured_polygon_ltc_technique(self, spot), wi);
    } else {
        u = textured_view_busy_invert(view, spot, at);
    }
    return cell_choice_united(spot.cell, u);
}

#endif
