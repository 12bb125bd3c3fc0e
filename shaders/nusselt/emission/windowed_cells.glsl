#ifndef NUSSELT_EMISSION_WINDOWED_CELLS_GLSL
#define NUSSELT_EMISSION_WINDOWED_CELLS_GLSL
// Follows include/nusselt/emission/windowed_polygon.h @ ab15301bae73
/// What WindowedPolygon and WindowedPolygonLtc share: the window of a light in its table, weights of cells, and samples
/// of texels. Twin of include/nusselt/emission/windowed_polygon.h, with 8 x 8 cells.

#include "../core/light_sample.glsl"
#include "../emission/textured_sample.glsl"
#include "../emission/window_cells.glsl"
#include "../emission/windowed_light.glsl"
#include "../geometry/polygon_measures.glsl"

/// A light whose radiance depends on the direction as seen from a shading point.
struct WindowedView {
    uint light, table;          ///< first words
    Frame frame;
    float distance;             ///< of the plane of the light; 0 if there is nothing to see
    TexturePlane plane;         ///< at distance one, with offsets of slopes as coordinates
    TexturePlane image;         ///< in the space where the measure is the projected solid angle
    WindowLines columns, rows;
    vec2 nearest;               ///< the point of the light next to the foot of the shading point [m]
    float lowest;               ///< samples of texels count above this z
    bool is_whole;              ///< whether the outline cuts no cell
};

struct WindowedCells {
    WindowedView view;
    CellSums sums; ///< of mean radiance over that of the table, times angle; without light, their total is 0
};

/// A vertex of the outline in the plane at distance one.
vec2 windowed_view_vertex(const WindowedView self, int k) {
    float inverse = 1.0 / self.distance;
    NUSSELT_PRECISE vec2 offset = inverse * (windowed_light_vertex(self.light, k) - self.nearest);
    NUSSELT_PRECISE vec2 vertex = offset - vec2(self.columns.slopes.move, self.rows.slopes.move);
    return vertex;
}
/// Whether all of a rectangle is inside of the outline.
bool windowed_view_contains(const WindowedView self, const TextureRectangle rectangle) {
    int count = windowed_light_vertices(self.light);
    bool inside = true;
    for (int k = 0; k < count; ++k)
        inside = inside && is_inside_of_edge(windowed_view_vertex(self, k),
                                             windowed_view_vertex(self, k + 1 < count ? k + 1 : 0), rectangle);
    return inside;
}
/// The part of a rectangle inside of the outline.
TexturePart windowed_view_part_in(const WindowedView self, const TextureRectangle rectangle) {
    TexturePart part;
    part.count = windowed_light_vertices(self.light);
    for (int k = 0; k < kNusseltMostCorners; ++k)
        part.corner[k] = windowed_view_vertex(self, k < part.count ? k : 0);
    return texture_part_in(part, rectangle);
}

/// The slopes of a side of the bounding box of a light, from the point of it next to the foot on.
SlopeInterval window_box_interval(float from, float to, float nearest, float foot, float inverse) {
    NUSSELT_PRECISE float low = inverse * (from - nearest);
    NUSSELT_PRECISE float high = inverse * (to - nearest);
    return SlopeInterval(inverse * (nearest - foot), low, high, 0.0);
}

TexelInterval window_texels(const SlopeInterval slopes, const TableAxis axis, float texel_size) {
    return table_axis_interval(axis, slope_interval_angle_at(slopes, slopes.low) / texel_size,
                               slope_interval_angle_at(slopes, slopes.high) / texel_size);
}

/// The slope where texel i begins.
float window_slope_at(int i, float angle_low, float texel_size) {
    float angle = angle_low + float(i) * texel_size;
    SinCos turn = sincos_quarter_turn(nusselt_min(abs(angle), 0.5 * kNusseltPi));
    return copysign(turn.sine / nusselt_max(turn.cosine, 1.0 / kNusseltLargestSlope), angle);
}

/// The part of a box between two lines of texels and within the slopes of a domain.
SlopeInterval window_lit_part(const SlopeInterval box, const TexelInterval texels, int begin, int end, float angle_low,
                              float texel_size, float from, float to) {
    if (begin > texels.first) from = nusselt_max(window_slope_at(begin, angle_low, texel_size), from);
    if (end <= texels.last) to = nusselt_min(window_slope_at(end, angle_low, texel_size), to);
    return slope_interval_cut(box, from, to);
}

/// Finds the lit part of the light in the plane at distance one, and the lines of its cells. The image is the plane.
/// \param plane of the light in shading space [m].
/// \param light first word.
WindowedView windowed_view_prepare(const WindowPlane plane, uint light) {
    WindowedView self;
    self.light = light;
    self.table = windowed_light_table(light);
    self.frame = plane.frame;
    self.distance = 0.0;
    self.lowest = 0.0;
    if (!(rectified_table_mean(self.table) > 0.0)) return self;

    // The bounding box in the plane, and its distance.
    vec2 low = windowed_light_vertex(light, 0);
    vec2 high = low;
    int count = windowed_light_vertices(light);
    for (int k = 1; k < count; ++k) {
        vec2 vertex = windowed_light_vertex(light, k);
        low = vec2(nusselt_min(low.x, vertex.x), nusselt_min(low.y, vertex.y));
        high = vec2(nusselt_max(high.x, vertex.x), nusselt_max(high.y, vertex.y));
    }
    // Polygons want normals that are right-handed with their sides.
    Frame frame = plane.frame;
    float hand = copysign(1.0, dot(nusselt_cross(frame.t, frame.b), frame.n));
    TexturePlane whole = TexturePlane(plane.corner, frame.t, frame.b, hand * frame.n);
    float distance = hand * plane_distance(polygon_in(whole, texture_part_of(TextureRectangle(low, high))));
    vec2 foot = vec2(-dot(frame.t, plane.corner), -dot(frame.b, plane.corner));
    vec2 to_low = abs(low - foot);
    vec2 to_high = abs(high - foot);
    float reach = nusselt_max(nusselt_max(to_low.x, to_high.x), nusselt_max(to_low.y, to_high.y));
    if (!(distance * kNusseltLargestSlope > reach)) return self;

    // Offsets in the plane are precise from the point next to the foot on.
    float inverse = 1.0 / distance;
    self.nearest = vec2(nusselt_max(nusselt_min(foot.x, high.x), low.x), nusselt_max(nusselt_min(foot.y, high.y), low.y));
    SlopeInterval box_x = window_box_interval(low.x, high.x, self.nearest.x, foot.x, inverse);
    SlopeInterval box_y = window_box_interval(low.y, high.y, self.nearest.y, foot.y, inverse);
    // What the table covers, and of this what is not black. Directions that are almost in the plane of the light have few
    // digits of their slopes left, and next to no solid angle.
    const vec2 steepest = vec2(65536.0);
    vec2 domain_low = clamp(rectified_table_domain_low(self.table), -steepest, steepest);
    vec2 domain_high = clamp(rectified_table_domain_high(self.table), -steepest, steepest);
    vec2 angle_low = rectified_table_angle_low(self.table);
    vec2 texel_size = rectified_table_texel_size(self.table);
    ivec2 size = rectified_table_size(self.table);
    SlopeInterval x = slope_interval_cut(box_x, domain_low.x, domain_high.x);
    SlopeInterval y = slope_interval_cut(box_y, domain_low.y, domain_high.y);
    if (slope_interval_is_empty(x) || slope_interval_is_empty(y)) return self;
    TableWindow window;
    window.table = self.table;
    window.across = window_axis_of(x, size.x, angle_low.x, texel_size.x);
    window.along = window_axis_of(y, size.y, angle_low.y, texel_size.y);
    window.columns = window_texels(x, window.across, texel_size.x);
    window.rows = window_texels(y, window.along, texel_size.y);
    TexelRectangle lit = table_window_lit(window);
    if (lit.begin.x == lit.end.x) return self;
    x = window_lit_part(box_x, window.columns, lit.begin.x, lit.end.x, angle_low.x, texel_size.x, domain_low.x,
                        domain_high.x);
    y = window_lit_part(box_y, window.rows, lit.begin.y, lit.end.y, angle_low.y, texel_size.y, domain_low.y,
                        domain_high.y);
    if (slope_interval_is_empty(x) || slope_interval_is_empty(y)) return self;
    self.columns = window_lines_prepare(x, size.x, angle_low.x, texel_size.x);
    self.rows = window_lines_prepare(y, size.y, angle_low.y, texel_size.y);

    self.plane = TexturePlane(frame.n + (x.origin * frame.t + y.origin * frame.b), frame.t, frame.b, hand * frame.n);
    self.image = self.plane;
    self.distance = distance;
    self.is_whole = windowed_view_contains(
        self, TextureRectangle(vec2(self.columns.offset[0], self.rows.offset[0]),
                               vec2(self.columns.offset[kNusseltCells], self.rows.offset[kNusseltCells])));
    return self;
}

/// Offsets of slopes in a cell.
TextureRectangle windowed_view_rectangle(WindowedView self, ivec2 cell) {
    return TextureRectangle(vec2(self.columns.offset[cell.x], self.rows.offset[cell.y]),
                            vec2(self.columns.offset[cell.x + 1], self.rows.offset[cell.y + 1]));
}
/// The part of a cell inside of the outline.
TexturePart windowed_view_part(const WindowedView self, ivec2 cell) {
    TextureRectangle rectangle = windowed_view_rectangle(self, cell);
    if (self.is_whole || windowed_view_contains(self, rectangle)) return texture_part_of(rectangle);
    return windowed_view_part_in(self, rectangle);
}
TableWindow windowed_view_window(const WindowedView self, ivec2 cell) {
    return TableWindow(self.table, self.columns.axis, self.rows.axis, window_lines_interval(self.columns, cell.x),
                       window_lines_interval(self.rows, cell.y));
}

/// The projected solid angle of a part of the image, also of one with more corners than polygons may have.
float windowed_view_clipped_angle(const WindowedView self, TexturePart part) {
    float sum = 0.0;
    for (int first = 1; first < kNusseltMostCorners - 1; first += NUSSELT_MAX_VERTICES - 2) {
        if (first + 1 >= part.count) break;
        TexturePart piece = part;
        for (int k = 1; k < NUSSELT_MAX_VERTICES; ++k) piece.corner[k] = part.corner[min(first + k - 1, part.count - 1)];
        piece.count = NUSSELT_MAX_VERTICES;
        sum = sum + projected_solid_angle(polygon_in(self.image, piece));
    }
    return sum;
}

/// The mean radiance of a cell over that of the table.
float windowed_view_mean(const WindowedView self, ivec2 cell) {
    TableWindow window = windowed_view_window(self, cell);
    float solid_angle = table_window_sum(window, kNusseltSolidAngle);
    return solid_angle > 0.0 ? table_window_sum(window, kNusseltWeight) / solid_angle : 0.0;
}

/// Adds up the weights of cells along columns.
WindowedCells windowed_cells_prepare(const WindowedView view) {
    WindowedCells self;
    self.view = view;
    self.sums.total = 0.0;
    if (!(view.distance > 0.0)) return self;
    window_cells_find_angles(view.image, view.columns, view.rows, self.sums.sum);
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; ++cell) {
        ivec2 at = ivec2(cell % kNusseltCells, cell / kNusseltCells);
        float angle = self.sums.sum[cell];
        TextureRectangle r = windowed_view_rectangle(view, at);
        // Heights of the corners.
        vec2 column = vec2(r.low.x, r.high.x) * view.image.side_x.z;
        vec2 row = vec2(r.low.y, r.high.y) * view.image.side_y.z;
        float lowest = view.image.corner.z + (nusselt_min(column.x, column.y) + nusselt_min(row.x, row.y));
        bool is_whole = view.is_whole || windowed_view_contains(view, r);
        if (!is_whole) {
            angle = windowed_view_clipped_angle(view, windowed_view_part_in(view, r));
        } else if (!(lowest >= 0.0)) {
            angle = windowed_view_clipped_angle(view, texture_part_of(r));
        }
        cell_sums_add(self.sums, cell, angle > 0.0 ? angle * windowed_view_mean(view, at) : 0.0);
    }
    cell_sums_finish(self.sums);
    return self;
}

/// The sum over cells of mean radiance times projected solid angle of the image.
float windowed_cells_total(const WindowedCells self) {
    return self.sums.total > 0.0 ? rectified_table_mean(self.view.table) * self.sums.total : 0.0;
}

/// The mean of the channels of a cell, per their mean.
vec3 windowed_view_hue(const WindowedView self, ivec2 cell) {
    TexelInterval x = window_lines_interval(self.columns, cell.x);
    TexelInterval y = window_lines_interval(self.rows, cell.y);
    vec3 top = rectified_table_colour_below(self.table, x.last + 1, y.last + 1) -
               rectified_table_colour_below(self.table, x.first, y.last + 1);
    vec3 bottom = rectified_table_colour_below(self.table, x.last + 1, y.first) -
                  rectified_table_colour_below(self.table, x.first, y.first);
    vec3 positive = nusselt_max(top - bottom, vec3(0.0));
    float mean = mean_of_channels(positive);
    return mean > 0.0 ? (1.0 / mean) * positive : vec3(1.0);
}

/// See WindowedPolygon::unshadowed() of C++.
vec3 windowed_cells_unshadowed(const WindowedCells self) {
    vec3 sum = vec3(0.0);
    if (!(self.sums.total > 0.0)) return sum;
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; ++cell) {
        ivec2 at = ivec2(cell % kNusseltCells, cell / kNusseltCells);
        SumStep part = cell_sums_cell_step(self.sums, at.x, at.y);
        float weight = part.after - part.before;
        if (weight > 0.0) sum = sum + weight * windowed_view_hue(self.view, at);
    }
    return (rectified_table_mean(self.view.table) / kNusseltPi) * sum;
}

/// Unit directions to the corners of a cell, and in between.
void windowed_view_directions(const WindowedView self, ivec2 cell, out vec3 wi[5]) {
    TextureRectangle r = windowed_view_rectangle(self, cell);
    wi[0] = nusselt_normalize(texture_plane_point_at(self.plane, r.low));
    wi[1] = nusselt_normalize(texture_plane_point_at(self.plane, vec2(r.high.x, r.low.y)));
    wi[2] = nusselt_normalize(texture_plane_point_at(self.plane, r.high));
    wi[3] = nusselt_normalize(texture_plane_point_at(self.plane, vec2(r.low.x, r.high.y)));
    wi[4] = nusselt_normalize(((wi[0] + wi[1]) + wi[2]) + wi[3]);
}

/// Whether the table varies less in a cell than the cosine or the lobe, in terms of squared coefficients of variation.
/// \param part      of the cell inside of the outline.
/// \param corners   cosine or lobe in the directions of windowed_view_directions().
/// \param at_centre in the last one.
bool windowed_view_is_smooth(const WindowedView self, ivec2 cell, const TexturePart part, vec4 corners,
                             float at_centre) {
    if (part.count > NUSSELT_MAX_VERTICES) return false;
    float variation = table_window_variation(windowed_view_window(self, cell));
    float mean = 2.0 / 3.0 * at_centre + 1.0 / 12.0 * ((corners.x + corners.y) + (corners.z + corners.w));
    float inverse = mean > 0.0 ? 1.0 / mean : 0.0;
    vec4 deviation = corners * inverse - vec4(1.0);
    float of_centre = at_centre * inverse - 1.0;
    float spread = 1.0 / 12.0 * dot(deviation, deviation) + 8.0 / 12.0 * of_centre * of_centre;

    TextureRectangle r = windowed_view_rectangle(self, cell);
    vec3 centre = texture_plane_point_at(self.image, 0.5 * (r.low + r.high));
    vec2 extent = r.high - r.low;
    vec3 area = nusselt_cross(extent.x * self.image.side_x, extent.y * self.image.side_y);
    float squared = dot(centre, centre);
    float solid_angle = abs(dot(area, centre)) / nusselt_max(squared * sqrt(squared), kNusseltTiny);
    return !(variation > solid_angle + 8.0 * kNusseltEpsilon) || !(mean > 0.0) || !(variation > spread);
}

vec2 windowed_view_clamped(const WindowedView self, vec2 at, ivec2 cell) {
    TextureRectangle r = windowed_view_rectangle(self, cell);
    return vec2(nusselt_max(nusselt_min(at.x, r.high.x), r.low.x), nusselt_max(nusselt_min(at.y, r.high.y), r.low.y));
}

/// Offsets of the point in a direction.
vec2 windowed_view_offset_of(const WindowedView self, vec3 p) {
    float z = dot(self.frame.n, p);
    float inverse = 1.0 / nusselt_max(z, kNusseltSmallestNormal);
    return vec2((dot(self.frame.t, p) - self.columns.slopes.origin * z) * inverse,
                (dot(self.frame.b, p) - self.rows.slopes.origin * z) * inverse);
}

/// Whether an offset is in an interval, up to rounding.
bool slope_interval_contains(const SlopeInterval self, float offset) {
    float slope = self.origin + offset;
    float rounding = 8.0 * kNusseltEpsilon * (1.0 + slope * slope);
    return offset >= self.low - rounding && offset <= self.high + rounding;
}
/// Whether a direction meets the window, up to rounding.
/// \param at its offsets.
bool windowed_view_is_hit(const WindowedView self, vec3 wi, vec2 at) {
    return dot(self.frame.n, wi) > 0.0 && slope_interval_contains(self.columns.slopes, at.x) &&
           slope_interval_contains(self.rows.slopes, at.y);
}
/// The cell with offsets.
CellChoice windowed_cells_cell_at(const WindowedCells self, vec2 at) {
    return cell_sums_cell(self.sums, ivec2(window_lines_cell_at(self.view.columns, at.x),
                                           window_lines_cell_at(self.view.rows, at.y)));
}

/// Positions in texels of offsets of slopes.
vec2 windowed_view_texels(const WindowedView self, vec2 at) {
    return vec2(window_lines_position_at(self.columns, at.x), window_lines_position_at(self.rows, at.y));
}
float table_axis_position(const TableAxis self, float offset) {
    return below_one((float(self.texel) + (self.fraction + offset)) / float(self.count));
}
/// The position in the table, from 0 to 1.
vec2 windowed_view_table_position(const WindowedView self, vec2 texels) {
    return vec2(table_axis_position(self.columns.axis, texels.x), table_axis_position(self.rows.axis, texels.y));
}

/// The sample of the technique in a smooth cell.
TexturedSample windowed_view_smooth_sample(const WindowedView self, const CellChoice cell, const LightSample s) {
    vec2 at = windowed_view_clamped(self, windowed_view_offset_of(self, s.p), cell.at);
    return TexturedSample(s.wi, cell.probability * s.pdf, self.distance * texture_plane_point_at(self.plane, at),
                          windowed_view_table_position(self, windowed_view_texels(self, at)));
}

/// The density of a direction in a texel.
/// \param window of the cell.
/// \param at     offsets of the direction.
float windowed_view_texel_density(const WindowedView self, const CellChoice cell, const TableWindow window,
                                  const WindowPoint point, vec2 at,
                                  vec3 wi) {
    if (!(wi.z > self.lowest)) return 0.0;
    if (!self.is_whole && !windowed_view_contains(self, windowed_view_rectangle(self, cell.at)) &&
        !windowed_view_contains(self, TextureRectangle(at, at)))
        return 0.0;
    float p = self.columns.slopes.origin + at.x;
    float q = self.rows.slopes.origin + at.y;
    float texel = self.columns.texel_size * self.rows.texel_size * rectified_jacobian(p, q);
    float density = cell.probability * (table_window_pdf(window, point) / texel);
    return texel > 0.0 ? nusselt_min(density, kNusseltLargest) : 0.0;
}

/// The sample of a texel in a busy cell.
TexturedSample windowed_view_busy_sample(const WindowedView self, const CellChoice cell) {
    TableWindow window = windowed_view_window(self, cell.at);
    WindowPoint point = table_window_sample(window, cell.u);
    vec2 at = vec2(window_lines_offset_at(self.columns, point.offset.x),
                   window_lines_offset_at(self.rows, point.offset.y));
    at = windowed_view_clamped(self, at, cell.at);
    vec3 p = texture_plane_point_at(self.plane, at);
    vec3 wi = nusselt_normalize(p);
    return TexturedSample(wi, windowed_view_texel_density(self, cell, window, point, at, wi), self.distance * p,
                          windowed_view_table_position(self, point.offset));
}

/// The density of a direction in a busy cell.
/// \param at its offsets.
float windowed_view_busy_density(const WindowedView self, const CellChoice cell, vec3 wi, vec2 at) {
    TableWindow window = windowed_view_window(self, cell.at);
    return windowed_view_texel_density(self, cell, window, table_window_point_at(window, windowed_view_texels(self, at)),
                                       at, wi);
}

/// The random numbers inside of a busy cell for offsets.
vec2 windowed_view_busy_invert(const WindowedView self, const CellChoice cell, vec2 at) {
    return table_window_invert(windowed_view_window(self, cell.at), windowed_view_texels(self, at));
}

#endif
