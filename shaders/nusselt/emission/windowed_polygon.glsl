#ifndef NUSSELT_EMISSION_WINDOWED_POLYGON_GLSL
#define NUSSELT_EMISSION_WINDOWED_POLYGON_GLSL
// Follows include/nusselt/emission/windowed_polygon.h @ ab15301bae73
/// Sampling of polygons whose radiance depends on the direction, in proportion to radiance times the cosine at the
/// surface. Twin of WindowedPolygon in include/nusselt/emission/windowed_polygon.h, with 8 x 8 cells.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space; the shading point is the origin, the normal +z.
/// Edge cases: nothing of the light above the horizon, black window, no area, point beyond or in the plane of the light,
/// or nearer to it than its extent over kNusseltLargestSlope: pdf = 0, measure 0. Samples in texels that the horizon or
/// the outline cuts may have pdf = 0.

#include "../emission/windowed_cells.glsl"
#include "../sampling/polygon_projected_solid_angle.glsl"

struct WindowedPolygon {
    // The fields of WindowedCells, because WebGL forbids structures that are nested more than four deep.
    WindowedView view;
    CellSums sums;
};

WindowedCells windowed_polygon_cells(const WindowedPolygon self) { return WindowedCells(self.view, self.sums); }

/// \param plane of the light in shading space [m]: to_shading_space(windowed_light_plane(light), point, frame).
/// \param light number of the first word of the light (windowed_light.glsl).
WindowedPolygon windowed_polygon_prepare(const WindowPlane plane, uint light) {
    WindowedCells cells = windowed_cells_prepare(windowed_view_prepare(plane, light));
    return WindowedPolygon(cells.view, cells.sums);
}

/// The sum over cells of mean radiance, averaged over channels, times projected solid angle [W/m^2].
float windowed_polygon_measure(const WindowedPolygon self) {
    return windowed_cells_total(windowed_polygon_cells(self));
}

/// The radiance that is reflected without shadows per albedo, per channel [W/(sr m^2)]: the coefficient of heuristics
/// for multiple importance sampling. Colours come from whole texels.
vec3 windowed_polygon_unshadowed(const WindowedPolygon self) {
    return windowed_cells_unshadowed(windowed_polygon_cells(self));
}

/// \param part of the cell inside of the outline.
bool windowed_polygon_is_smooth(const WindowedView view, ivec2 cell, const TexturePart part) {
    vec3 wi[5];
    windowed_view_directions(view, cell, wi);
    vec4 corners = vec4(nusselt_max(wi[0].z, 0.0), nusselt_max(wi[1].z, 0.0), nusselt_max(wi[2].z, 0.0),
                        nusselt_max(wi[3].z, 0.0));
    return windowed_view_is_smooth(view, cell, part, corners, nusselt_max(wi[4].z, 0.0));
}

/// The technique inside of a smooth cell.
PolygonProjectedSolidAngle windowed_polygon_technique(const WindowedView view, const TexturePart part) {
    return polygon_projected_solid_angle_prepare(polygon_in(view.plane, part));
}

/// \param u in [0, 1)^2; x chooses along the x axis of the light, y along its y axis: stratification survives in part.
/// \return `at` is the position in the table, from 0 to 1. The point of a portal is only where the ray leaves: shadow
///         rays go on along wi to infinity.
TexturedSample windowed_polygon_sample(const WindowedPolygon self, vec2 u) {
    if (!(self.sums.total > 0.0)) return no_textured_sample();
    WindowedView view = self.view;
    CellChoice cell = cell_sums_choose(self.sums, u);
    TexturePart part = windowed_view_part(view, cell.at);
    if (!windowed_polygon_is_smooth(view, cell.at, part)) return windowed_view_busy_sample(view, cell);
    return windowed_view_smooth_sample(
        view, cell, polygon_projected_solid_angle_sample(windowed_polygon_technique(view, part), cell.u));
}

/// \param wi a unit direction towards the light; the density is 0 where it is black. Beside the light, it may be
///           positive.
float windowed_polygon_pdf(const WindowedPolygon self, vec3 wi) {
    if (!(self.sums.total > 0.0)) return 0.0;
    WindowedView view = self.view;
    vec2 at = windowed_view_offset_of(view, wi);
    if (!windowed_view_is_hit(view, wi, at)) return 0.0;
    CellChoice cell = windowed_cells_cell_at(windowed_polygon_cells(self), at);
    if (!(cell.probability > 0.0)) return 0.0;
    TexturePart part = windowed_view_part(view, cell.at);
    if (!windowed_polygon_is_smooth(view, cell.at, part)) return windowed_view_busy_density(view, cell, wi, at);
    return cell.probability * polygon_projected_solid_angle_pdf(windowed_polygon_technique(view, part), wi);
}

/// The random numbers for which the sample is wi, a unit direction with a density.
vec2 windowed_polygon_invert(const WindowedPolygon self, vec3 wi) {
    if (!(self.sums.total > 0.0)) return vec2(0.0);
    WindowedView view = self.view;
    vec2 at = windowed_view_offset_of(view, wi);
    if (!windowed_view_is_hit(view, wi, at)) return vec2(0.0);
    CellChoice cell = windowed_cells_cell_at(windowed_polygon_cells(self), at);
    TexturePart part = windowed_view_part(view, cell.at);
    vec2 u;
    if (windowed_polygon_is_smooth(view, cell.at, part)) {
        u = polygon_projected_solid_angle_invert(windowed_polygon_technique(view, part), wi);
    } else {
        u = windowed_view_busy_invert(view, cell, at);
    }
    return cell_choice_united(cell, u);
}

#endif
