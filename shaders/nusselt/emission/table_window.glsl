#ifndef NUSSELT_EMISSION_TABLE_WINDOW_GLSL
#define NUSSELT_EMISSION_TABLE_WINDOW_GLSL
// Follows include/nusselt/emission/table_window.h @ 2403d08bc661
/// Windows of a rectified table: their sums, their lit part, and samples in proportion to the table. Twin of
/// include/nusselt/emission/table_window.h, where positions are explained. Sums of cells are those of their windows:
/// C++ takes differences of sums in double.

#include "../emission/cell_sums.glsl"
#include "../emission/rectified_table.glsl"

/// An interval of offsets, and the texels that it meets.
struct TexelInterval {
    float begin, end;
    int first, last; ///< texels
};

/// Where sums over the interval change from one share of texels to another.
int texel_interval_edge(const TexelInterval self, int k) {
    if (k == 0) return self.first;
    if (k == 1) return self.first + 1;
    return k == 2 ? max(self.last, self.first + 1) : self.last + 1;
}

/// Offsets along alpha or beta.
struct TableAxis {
    int count;      ///< texels
    int texel;      ///< with the origin of offsets
    float fraction; ///< of this texel before the origin
};

/// \param position of the origin in the table, in texels.
TableAxis make_table_axis(int texels, float position) {
    float inside = nusselt_min(nusselt_max(position, 0.0), float(texels));
    int texel = min(int(floor(inside)), texels - 1);
    return TableAxis(texels, texel, inside - float(texel));
}

/// Where texel i begins.
float table_axis_edge(const TableAxis self, int i) { return float(i - self.texel) - self.fraction; }
int table_axis_texel_at(const TableAxis self, float offset) {
    float limit = float(2 * self.count);
    int steps = int(floor(nusselt_min(nusselt_max(offset + self.fraction, -limit), limit)));
    return clamp(self.texel + steps, 0, self.count - 1);
}
TexelInterval table_axis_interval(const TableAxis self, float begin, float end) {
    int first = table_axis_texel_at(self, begin);
    return TexelInterval(begin, end, first, max(table_axis_texel_at(self, end), first));
}
/// What an interval has of the texels between its edges k and k + 1: a length, or 1 for whole texels.
float table_axis_share(const TableAxis self, const TexelInterval x, int k) {
    if (x.last == x.first) return k == 0 ? x.end - x.begin : 0.0;
    if (k == 0) return nusselt_max(table_axis_edge(self, x.first + 1) - x.begin, 0.0);
    return k == 1 ? 1.0 : nusselt_max(x.end - table_axis_edge(self, x.last), 0.0);
}
/// The part of an interval in a texel.
vec2 table_axis_part(const TableAxis self, const TexelInterval x, int i) {
    float begin = i > x.first ? table_axis_edge(self, i) : x.begin;
    float end = i < x.last ? table_axis_edge(self, i + 1) : x.end;
    return vec2(nusselt_min(begin, x.end), nusselt_max(end, begin));
}

/// A point in a window.
struct WindowPoint {
    ivec2 texel;
    vec2 offset; ///< in texels
};

/// A rectangle of a table.
struct TableWindow {
    uint table;              ///< first word
    TableAxis across, along; ///< alpha and beta
    TexelInterval columns, rows;
};

TableAxis table_window_axis(const TableWindow self, int axis) {
    if (axis == 0) return self.across;
    return self.along;
}
TexelInterval table_window_interval(const TableWindow self, int axis) {
    if (axis == 0) return self.columns;
    return self.rows;
}

/// A quantity over that of the table, where parts of texels have their share by area in (alpha, beta).
float table_window_sum(const TableWindow self, uint quantity) {
    float total = 0.0;
    uvec2 below[3]; // differences of the columns' sums up to the last row
    for (int l = 0; l < 4; ++l) {
        int j = texel_interval_edge(self.rows, l);
        float share_y = l > 0 ? kNusseltTableShare * table_axis_share(self.along, self.rows, l - 1) : 0.0;
        uvec2 left = rectified_table_below(self.table, quantity, self.columns.first, j);
        for (int k = 0; k < 3; ++k) {
            uvec2 right =
                rectified_table_below(self.table, quantity, texel_interval_edge(self.columns, k + 1), j);
            uvec2 strip = difference_of_pairs(right, left);
            float share = share_y * table_axis_share(self.across, self.columns, k);
            if (share > 0.0) total = total + share * pair_to_float(difference_of_pairs(strip, below[k]));
            below[k] = strip;
            left = right;
        }
    }
    return total;
}

/// The squared coefficient of variation of the radiance of texels, by solid angle.
float table_window_variation(const TableWindow self) {
    vec3 sum; // weight, square and solid angle, in the order of their words
    for (int k = 0; k < 3; ++k) sum[k] = table_window_sum(self, 2u * uint(k));
    if (!(sum.x > 0.0)) return 0.0;
    float ratio = rectified_table_mean_square(self.table) * (sum.y / sum.x) * (sum.z / sum.x);
    return nusselt_max(ratio - 1.0, 0.0);
}

/// The weight of columns from one to before another, all of them whole.
float table_window_strip(const TableWindow self, int first, int end) {
    NUSSELT_PRECISE float total = 0.0;
    for (int k = 0; k < 3; ++k) {
        float share = table_axis_share(self.along, self.rows, k);
        if (share > 0.0) {
            ivec2 rows = ivec2(texel_interval_edge(self.rows, k), texel_interval_edge(self.rows, k + 1));
            total = total + share * rectified_table_weight(self.table, TexelRectangle(ivec2(first, rows.x),
                                                                                      ivec2(end, rows.y)));
        }
    }
    return total;
}
/// The weight of columns (axis 0), or of the rows of one whole column (axis 1), up to the end of one. Grows with it, in
/// spite of rounding.
/// \param column whose rows are summed.
float table_window_sum_to(const TableWindow self, int axis, int column, int texel) {
    TexelInterval x = table_window_interval(self, axis);
    NUSSELT_PRECISE float total = 0.0;
    for (int k = 0; k < 3; ++k) {
        int first = texel_interval_edge(x, k);
        int end = min(texel_interval_edge(x, k + 1), texel + 1);
        if (first < end) {
            float weight = 0.0;
            if (axis == 0) {
                weight = table_window_strip(self, first, end);
            } else {
                weight = rectified_table_weight(self.table,
                                                TexelRectangle(ivec2(column, first), ivec2(column + 1, end)));
            }
            total = total + table_axis_share(table_window_axis(self, axis), x, k) * weight;
        }
    }
    return total;
}

/// Chooses a column, or a row of a column, and an offset in it.
float table_window_choose(const TableWindow self, int axis, int column, float u, out int texel) {
    TexelInterval interval = table_window_interval(self, axis);
    int low = interval.first;
    int high = interval.last;
    float total = table_window_sum_to(self, axis, column, high);
    float target = below_one(u) * total;
    SumStep step = SumStep(0.0, total, total); // between the sums before `low` and up to `high`
    for (int k = 0; k < kNusseltTableHalvings; ++k) {
        int middle = (low + high) >> 1;
        if (low < high) {
            float sum = table_window_sum_to(self, axis, column, middle);
            if (sum > target) {
                high = middle;
                step.after = sum;
            } else {
                low = middle + 1;
                step.before = sum;
            }
        }
    }
    texel = low;
    vec2 part = table_axis_part(table_window_axis(self, axis), interval, low);
    return part.x + sum_step_rest(step, target) * (part.y - part.x);
}

/// A point with a density in proportion to the weight of its texel, uniform in (alpha, beta) within it. The window has to
/// have a weight.
WindowPoint table_window_sample(const TableWindow self, vec2 u) {
    WindowPoint point;
    int column = 0;
    // A loop, because compilers inline all functions.
    for (int axis = 0; axis < 2; ++axis) {
        int texel;
        point.offset[axis] = table_window_choose(self, axis, column, u[axis], texel);
        point.texel[axis] = texel;
        column = texel;
    }
    return point;
}

/// The texel of the window with these offsets.
WindowPoint table_window_point_at(const TableWindow self, vec2 offset) {
    return WindowPoint(
        ivec2(clamp(table_axis_texel_at(self.across, offset.x), self.columns.first, self.columns.last),
              clamp(table_axis_texel_at(self.along, offset.y), self.rows.first, self.rows.last)),
        offset);
}

/// The random number that leads to a position in a column, or in a row of a column.
float table_window_number(const TableWindow self, int axis, int column, int texel, float position) {
    TexelInterval interval = table_window_interval(self, axis);
    vec2 part = table_axis_part(table_window_axis(self, axis), interval, texel);
    float size = part.y - part.x;
    float rest = size > 0.0 ? below_one((position - part.x) / size) : 0.0;
    float sum[3]; // before the texel, up to its end, and in all; a loop, because compilers inline all functions
    for (int k = 0; k < 3; ++k)
        sum[k] = table_window_sum_to(self, axis, column, k < 2 ? texel + k - 1 : interval.last);
    return sum_step_united(SumStep(sum[0], sum[1], sum[2]), rest);
}

/// The random numbers that lead to offsets in the window.
vec2 table_window_invert(const TableWindow self, vec2 offset) {
    WindowPoint point = table_window_point_at(self, offset);
    vec2 u;
    for (int axis = 0; axis < 2; ++axis)
        u[axis] = table_window_number(self, axis, point.texel.x, point.texel[axis], offset[axis]);
    return u;
}

/// The density of table_window_sample() per square texel.
float table_window_pdf(const TableWindow self, const WindowPoint point) {
    float weight = kNusseltTableShare *
                   rectified_table_weight(self.table, TexelRectangle(point.texel, point.texel + 1));
    float total = table_window_sum(self, kNusseltWeight);
    return total > 0.0 ? weight / total : 0.0;
}

/// How many columns (axis 0) or rows at an end of a rectangle have no weight. Some of it has one.
int black_lines_of(uint table, TexelRectangle r, int axis, bool at_end) {
    int first = 0;
    int last = r.end[axis] - r.begin[axis] - 1;
    // Mostly none.
    for (int k = 0; k <= kNusseltTableHalvings; ++k) {
        int middle = k == 0 ? 1 : last - ((last - first) >> 1);
        if (first < last) {
            TexelRectangle left_out = r;
            if (at_end) {
                left_out.begin[axis] = r.end[axis] - middle;
            } else {
                left_out.end[axis] = r.begin[axis] + middle;
            }
            if (rectified_table_is_black(table, left_out)) {
                first = middle;
            } else {
                last = middle - 1;
            }
        }
    }
    return first;
}

/// The smallest rectangle of whole texels with all of the weight of those that the window meets.
TexelRectangle table_window_lit(const TableWindow self) {
    TexelRectangle lit = TexelRectangle(ivec2(self.columns.first, self.rows.first),
                                        ivec2(self.columns.last, self.rows.last) + 1);
    if (rectified_table_is_black(self.table, lit)) return TexelRectangle(ivec2(0), ivec2(0));
    for (int axis = 0; axis < 2; ++axis) {
        lit.begin[axis] += black_lines_of(self.table, lit, axis, false);
        lit.end[axis] -= black_lines_of(self.table, lit, axis, true);
    }
    return lit;
}

#endif
