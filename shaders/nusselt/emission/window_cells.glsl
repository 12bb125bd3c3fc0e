#ifndef NUSSELT_EMISSION_WINDOW_CELLS_GLSL
#define NUSSELT_EMISSION_WINDOW_CELLS_GLSL
// Follows include/nusselt/emission/window_cells.h @ a8ab3ae072ea
/// The cells of a window: equal steps in alpha and beta, which are rectangles of unequal size in the plane of slopes.
/// Twin of include/nusselt/emission/window_cells.h, with 8 x 8 cells. As in cell_lattice.glsl, one row is computed after
/// the other.

#include "../core/trig.glsl"
#include "../emission/cell_sums.glsl"
#include "../emission/table_window.glsl"
#include "../emission/term_line.glsl"
#include "../emission/texture_part.glsl"

/// An interval of slopes, as offsets from the slope in it that is next to zero.
struct SlopeInterval {
    float origin;    ///< slope
    float low, high; ///< offsets, low <= 0 <= high unless it is empty
    float move;      ///< of the origin, from that of the interval that this one is a part of
};

bool slope_interval_is_empty(const SlopeInterval self) { return !(self.low < self.high); }

/// The part between two slopes.
SlopeInterval slope_interval_cut(const SlopeInterval self, float from, float to) {
    float begin = nusselt_max(self.low, from - self.origin);
    float end = nusselt_min(self.high, to - self.origin);
    NUSSELT_PRECISE float by = nusselt_max(nusselt_min(0.0, end), begin);
    NUSSELT_PRECISE float low = begin - by;
    return SlopeInterval(self.origin + by, low, end - by, by);
}
/// The angle between the origin and an offset [rad].
float slope_interval_angle_at(const SlopeInterval self, float offset) {
    // Offsets have the sign of the origin, so that nothing cancels.
    float x = nusselt_max(nusselt_fma(self.origin, self.origin + offset, 1.0), 0.0);
    return copysign(atan2_positive(abs(offset), x), offset);
}
/// What slope_interval_angle_at() undoes.
float slope_interval_offset_at(const SlopeInterval self, float angle) {
    SinCos turn = sincos_quarter_turn(nusselt_min(abs(angle), 0.5 * kNusseltPi));
    float sine = copysign(turn.sine, angle);
    float x = turn.cosine - self.origin * sine;
    float offset =
        nusselt_fma(self.origin, self.origin, 1.0) * sine / nusselt_max(x, kNusseltSmallestNormal);
    return nusselt_min(nusselt_max(offset, self.low), self.high);
}

/// The lines of cells along one direction.
struct WindowLines {
    SlopeInterval slopes;
    TableAxis axis;
    float texel_size;                   ///< [rad]
    float offset[kNusseltCells + 1];    ///< of slopes
    float position[kNusseltCells + 1];  ///< in texels
};

/// \param count of texels.
/// \param angle_low where they begin, texel_size how large they are [rad].
TableAxis window_axis_of(const SlopeInterval interval, int count, float angle_low, float texel_size) {
    float angle = copysign(atan2_positive(abs(interval.origin), 1.0), interval.origin);
    return make_table_axis(count, (angle - angle_low) / texel_size);
}

/// \param count, angle_low, texel_size see window_axis_of().
WindowLines window_lines_prepare(const SlopeInterval interval, int count, float angle_low, float texel_size) {
    WindowLines self;
    self.slopes = interval;
    self.axis = window_axis_of(interval, count, angle_low, texel_size);
    self.texel_size = texel_size;
    float low = slope_interval_angle_at(interval, interval.low);
    float high = slope_interval_angle_at(interval, interval.high);
    float inverse = 1.0 / texel_size;
    float before = interval.low;
    for (int i = 0; i <= kNusseltCells; ++i) {
        float angle = low + (float(i) * (1.0 / float(kNusseltCells))) * (high - low);
        if (i > 0) before = nusselt_max(slope_interval_offset_at(interval, angle), before);
        if (i == kNusseltCells) {
            before = interval.high;
            angle = high;
        }
        self.offset[i] = before;
        self.position[i] = inverse * angle;
    }
    return self;
}

/// The cell with an offset of slopes.
int window_lines_cell_at(WindowLines self, float x) {
    int found = 0;
    for (int k = kNusseltCells / 2; k > 0; k /= 2) found += self.offset[found + k] <= x ? k : 0;
    return found;
}
float window_lines_offset_at(const WindowLines self, float texels) {
    return slope_interval_offset_at(self.slopes, texels * self.texel_size);
}
float window_lines_position_at(const WindowLines self, float x) {
    return slope_interval_angle_at(self.slopes, x) / self.texel_size;
}
/// Texels of a cell.
TexelInterval window_lines_interval(WindowLines self, int cell) {
    return table_axis_interval(self.axis, self.position[cell], self.position[cell + 1]);
}

/// The cosine at the centre of each cell.
void window_cells_find_far_angles(const TexturePlane plane, WindowLines x, WindowLines y, float distance,
                                  inout float angle[kNusseltCells * kNusseltCells]) {
    float scale = abs(distance) * texture_plane_area(plane);
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; ++cell) {
        int i = cell % kNusseltCells;
        int j = cell / kNusseltCells;
        vec2 size = vec2(x.offset[i + 1] - x.offset[i], y.offset[j + 1] - y.offset[j]);
        vec3 p = texture_plane_point_at(plane, vec2(x.offset[i], y.offset[j]) + 0.5 * size);
        float squared = dot(p, p);
        angle[cell] = scale * size.x * size.y * (nusselt_max(p.z, 0.0) / squared) / squared;
    }
}

/// \param sign of the distance of the plane.
void window_cells_find_near_angles(const TexturePlane plane, WindowLines x, WindowLines y,
                                   float sign_of_distance,
                                   inout float angle[kNusseltCells * kNusseltCells]) {
    const int n = kNusseltCells;
    vec2 len = vec2(nusselt_length(plane.side_x), nusselt_length(plane.side_y));
    vec3 direction_x = nusselt_normalize(plane.side_x);
    vec3 direction_y = nusselt_normalize(plane.side_y);
    vec2 low = len * vec2(x.offset[0], y.offset[0]);
    vec2 high = len * vec2(x.offset[n], y.offset[n]);

    TermLine columns[n + 1];
    NUSSELT_UNROLL for (int i = 0; i <= n; ++i)
        columns[i] = make_uncut_term_line(texture_plane_point_at(plane, vec2(x.offset[i], 0.0)), direction_y, low.y,
                                          high.y);
    float below[n]; // terms of the sides between the last row and the next one
    NUSSELT_UNROLL for (int j = 0; j <= n; ++j) {
        TermLine line = make_uncut_term_line(texture_plane_point_at(plane, vec2(0.0, y.offset[j])), direction_x, low.x,
                                             high.x);
        float from = len.y * y.offset[max(j - 1, 0)];
        float to = len.y * y.offset[j];
        float left = term_line_term(columns[0], from, to);
        NUSSELT_UNROLL for (int i = 0; i < n; ++i) {
            float top = term_line_term(line, len.x * x.offset[i], len.x * x.offset[i + 1]);
            if (j > 0) {
                float right = term_line_term(columns[i + 1], from, to);
                float bottom = below[i];
                float least = (8.0 * kNusseltEpsilon) * ((abs(left) + abs(right)) + (abs(bottom) + abs(top)));
                angle[(j - 1) * n + i] =
                    0.5 * nusselt_max(sign_of_distance * ((right - left) - (top - bottom)), least);
                left = right;
            }
            below[i] = top;
        }
    }
}

/// Projected solid angles [sr] of all cells, cell (i, j) at 8 j + i, as if the horizon cut none of them. They are not
/// zero, but at least as large as their rounding errors.
/// \param plane with coordinates of the order of its distance, in shading space or in the cosine space of a lobe.
void window_cells_find_angles(const TexturePlane plane, const WindowLines x, const WindowLines y,
                              out float angle[kNusseltCells * kNusseltCells]) {
    const float far = 1.0 / 16.0; // kFarIfCut of C++ for float
    vec2 low = vec2(x.offset[0], y.offset[0]);
    vec2 high = vec2(x.offset[kNusseltCells], y.offset[kNusseltCells]);
    float distance = plane_distance(polygon_in(plane, texture_part_of(TextureRectangle(low, high))));
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; ++cell) angle[cell] = 0.0;
    if (distance == 0.0) return;
    vec3 centre = texture_plane_point_at(plane, 0.5 * (low + high));
    float size = nusselt_length(plane.side_x) * (high.x - low.x) + nusselt_length(plane.side_y) * (high.y - low.y);
    if (size * size < far * far * dot(centre, centre)) {
        window_cells_find_far_angles(plane, x, y, distance, angle);
    } else {
        window_cells_find_near_angles(plane, x, y, copysign(1.0, distance), angle);
    }
}

#endif
