#ifndef NUSSELT_EMISSION_WINDOWED_POLYGON_LTC_GLSL
#define NUSSELT_EMISSION_WINDOWED_POLYGON_LTC_GLSL
// Follows include/nusselt/emission/windowed_polygon.h @ ab15301bae73
/// Sampling of polygons whose radiance depends on the direction, in proportion to radiance times a glossy lobe. Twin of
/// WindowedPolygonLtc in include/nusselt/emission/windowed_polygon.h, with 8 x 8 cells.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space with wo in the xz half-plane (shading_frame()). Samples may lie below the surface, wi.z < 0:
/// they count, with a contribution of zero.
/// Edge cases: nothing of the light in the lobe, black window, no area, point beyond or in the plane of the light, or
/// nearer to it than its extent over kNusseltLargestSlope: pdf = 0, measure 0. Samples in texels that the outline cuts
/// may have pdf = 0.

#include "../emission/windowed_cells.glsl"
#include "../sampling/polygon_ltc.glsl"

struct WindowedPolygonLtc {
    // The fields of WindowedCells, because WebGL forbids structures that are nested more than four deep.
    WindowedView view;
    CellSums sums;
    Ltc ltc;
};

WindowedCells windowed_polygon_ltc_cells(const WindowedPolygonLtc self) { return WindowedCells(self.view, self.sums); }

/// \param plane of the light in shading space [m]: to_shading_space(windowed_light_plane(light), point, frame).
/// \param light number of the first word of the light (windowed_light.glsl).
WindowedPolygonLtc windowed_polygon_ltc_prepare(const WindowPlane plane, uint light, const Ltc ltc) {
    WindowedView view = windowed_view_prepare(plane, light);
    view.image = TexturePlane(ltc_to_cosine(ltc, view.plane.corner), ltc_to_cosine(ltc, view.plane.side_x),
                              ltc_to_cosine(ltc, view.plane.side_y),
                              nusselt_normalize(ltc_normal_to_cosine(ltc, view.plane.normal)));
    view.lowest = -kNusseltLargest;
    WindowedCells cells = windowed_cells_prepare(view);
    return WindowedPolygonLtc(cells.view, cells.sums, ltc);
}

/// The sum over cells of mean radiance, averaged over channels, times the integral of the lobe [W/(sr m^2)].
float windowed_polygon_ltc_measure(const WindowedPolygonLtc self) {
    return (1.0 / kNusseltPi) * windowed_cells_total(windowed_polygon_ltc_cells(self));
}

/// See windowed_polygon_unshadowed().
vec3 windowed_polygon_ltc_unshadowed(const WindowedPolygonLtc self) {
    return windowed_cells_unshadowed(windowed_polygon_ltc_cells(self));
}

/// \param part of the cell inside of the outline.
bool windowed_polygon_ltc_is_smooth(const WindowedPolygonLtc self, ivec2 cell, const TexturePart part) {
    vec3 wi[5];
    windowed_view_directions(self.view, cell, wi);
    vec4 corners = vec4(ltc_density(self.ltc, wi[0]), ltc_density(self.ltc, wi[1]), ltc_density(self.ltc, wi[2]),
                        ltc_density(self.ltc, wi[3]));
    return windowed_view_is_smooth(self.view, cell, part, corners, ltc_density(self.ltc, wi[4]));
}

/// The technique inside of a smooth cell.
PolygonLtc windowed_polygon_ltc_technique(const WindowedPolygonLtc self, const TexturePart part) {
    return polygon_ltc_prepare(polygon_in(self.view.plane, part), self.ltc);
}

/// \param u in [0, 1)^2; see windowed_polygon_sample().
TexturedSample windowed_polygon_ltc_sample(const WindowedPolygonLtc self, vec2 u) {
    if (!(self.sums.total > 0.0)) return no_textured_sample();
    WindowedView view = self.view;
    CellChoice cell = cell_sums_choose(self.sums, u);
    TexturePart part = windowed_view_part(view, cell.at);
    if (!windowed_polygon_ltc_is_smooth(self, cell.at, part)) return windowed_view_busy_sample(view, cell);
    return windowed_view_smooth_sample(view, cell,
                                       polygon_ltc_sample(windowed_polygon_ltc_technique(self, part), cell.u));
}

/// \param wi a unit direction towards the light; the density is 0 where it is black. Beside the light, it may be
///           positive.
float windowed_polygon_ltc_pdf(const WindowedPolygonLtc self, vec3 wi) {
    if (!(self.sums.total > 0.0)) return 0.0;
    WindowedView view = self.view;
    vec2 at = windowed_view_offset_of(view, wi);
    if (!windowed_view_is_hit(view, wi, at)) return 0.0;
    CellChoice cell = windowed_cells_cell_at(windowed_polygon_ltc_cells(self), at);
    if (!(cell.probability > 0.0)) return 0.0;
    TexturePart part = windowed_view_part(view, cell.at);
    if (!windowed_polygon_ltc_is_smooth(self, cell.at, part)) return windowed_view_busy_density(view, cell, wi, at);
    return cell.probability * polygon_ltc_pdf(windowed_polygon_ltc_technique(self, part), wi);
}

/// The random numbers for which the sample is wi, a unit direction with a density.
vec2 windowed_polygon_ltc_invert(const WindowedPolygonLtc self, vec3 wi) {
    if (!(self.sums.total > 0.0)) return vec2(0.0);
    WindowedView view = self.view;
    vec2 at = windowed_view_offset_of(view, wi);
    if (!windowed_view_is_hit(view, wi, at)) return vec2(0.0);
    CellChoice cell = windowed_cells_cell_at(windowed_polygon_ltc_cells(self), at);
    TexturePart part = windowed_view_part(view, cell.at);
    vec2 u;
    if (windowed_polygon_ltc_is_smooth(self, cell.at, part)) {
        u = polygon_ltc_invert(windowed_polygon_ltc_technique(self, part), wi);
    } else {
        u = windowed_view_busy_invert(view, cell, at);
    }
    return cell_choice_united(cell, u);
}

#endif
