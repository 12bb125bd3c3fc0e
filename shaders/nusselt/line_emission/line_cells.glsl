#ifndef NUSSELT_LINE_EMISSION_LINE_CELLS_GLSL
#define NUSSELT_LINE_EMISSION_LINE_CELLS_GLSL
// Follows include/nusselt/line_emission/textured_line.h @ b972ffb2caa5
/// What TexturedLine and TexturedLineLtc share: they choose a cell in proportion to the mean of radiance at both ends times the
/// closed form of its measure, and a point in the cell by a linear density. Twin of include/nusselt/line_emission/textured_line.h.

#include "../core/light_sample.glsl"
#include "../line_emission/line_profile.glsl"
#include "../geometry/clip_line.glsl"

/// A thread has no memory for a number per cell: weights are computed again where they are needed.
struct LineCells {
    uint profile;        ///< first word
    LineSegment line;    ///< scaled to coordinates of order one
    LineSegment image;   ///< in the space where measures are projected solid angles
    float inverse_scale; ///< a power of two
    float unit;          ///< measures of the light over projected solid angles of its image
    vec2 lit;            ///< the part that counts, in shares of the length
    float total;         ///< of weights, 0 without light
    vec3 expected;       ///< sum of mean radiance times measure
};

/// What is above the horizon of a part of a line.
vec2 lit_part_above(const LineSegment line, vec2 part) {
    float start = line.p0.z;
    float end = end_of(line).z;
    if (start <= 0.0 && end <= 0.0) return vec2(0.0);
    if (start >= 0.0 && end >= 0.0) return part;
    float crossing = start / (start - end);
    return start < 0.0 ? vec2(nusselt_max(part.x, crossing), part.y) : vec2(part.x, nusselt_min(part.y, crossing));
}

/// The sums of a range of cells that begins with the first one.
struct LineSums {
    int cell;      ///< the last one
    float before;  ///< weights of the others
    float weight;  ///< of this one
    vec3 expected; ///< mean radiance times measure, of all
};

/// Adds up cells until their weights exceed a target, or up to a cell.
LineSums line_cells_sums(const LineCells self, float target, int last_cell) {
    LineSums sums = LineSums(0, 0.0, 0.0, vec3(0.0));
    float high = line_profile_border(self.profile, 0);
    vec3 radiance_high = line_profile_radiance(self.profile, 0);
    for (int k = 0; k <= last_cell && !(sums.before + sums.weight > target); ++k) {
        sums.cell = k;
        sums.before += sums.weight;
        // Cut the cell to the part that counts.
        float low = high;
        vec3 radiance_low = radiance_high;
        high = line_profile_border(self.profile, k + 1);
        radiance_high = line_profile_radiance(self.profile, k + 1);
        float begin = nusselt_min(nusselt_max(low, self.lit.x), high);
        float end = nusselt_max(nusselt_min(high, self.lit.y), begin);
        LineSegment image = self.image;
        float unlimited = self.unit *
                          projected_solid_angle(LineSegment(nusselt_fma(image.len * begin, image.s, image.p0),
                                                            image.s, image.len * (end - begin)));
        // Those of denormal lines may overflow, and black cells must not turn that into NaN.
        float share = nusselt_min(nusselt_max(unlimited, 0.0), kNusseltLargest);
        // Interpolation at both ends, which takes half of what lies within.
        float last = 0.5 * ((begin - low) + (end - low)) / (high - low);
        vec3 mean = (1.0 - last) * radiance_low + last * radiance_high;
        sums.weight = share * mean_of_channels(mean);
        sums.expected += share * mean;
    }
    return sums;
}

/// \param line  in shading space, with coordinates of order one.
/// \param image of the line, in the space where measures are projected solid angles: the line itself, or its image in cosine
///              space.
/// \param ratio measures of parts of the line over projected solid angles of their images.
/// \param scale by which the line is larger than the light.
LineCells line_cells_prepare(const LineSegment line, const LineSegment image, float ratio, float scale, uint profile) {
    LineCells self;
    self.profile = profile;
    self.line = line;
    self.image = image;
    self.inverse_scale = reciprocal_power_of_two(scale);
    self.unit = scale * ratio;
    // Parts of the line have the same lengths in its image, up to a factor.
    self.lit = lit_part_above(line, lit_part_above(image, vec2(0.0, 1.0)));
    LineSums sums = line_cells_sums(self, kNusseltLargest, line_profile_cells(profile) - 1);
    float total = sums.before + sums.weight;
    self.total = is_finite(total) ? total : 0.0;
    self.expected = self.total > 0.0 ? nusselt_min(sums.expected, vec3(kNusseltLargest)) : vec3(0.0);
    return self;
}

vec3 line_cells_point_at(const LineCells self, float at) {
    return exact_fma(at * self.line.len, self.line.s, self.line.p0);
}

/// Where a direction meets the line, as a share of its length.
float line_cells_position_of(const LineCells self, vec3 wi) {
    CenteredLine line = centered(self.line);
    float ahead = nusselt_max(dot(wi, line.closest), kNusseltSmallestNormal);
    float l = nusselt_min(nusselt_max(line.squared * (dot(wi, line.inward) / ahead), line.near_l), line.far_l);
    float distance = line.sign_of_s > 0.0 ? l - line.near_l : line.far_l - l;
    return nusselt_min(nusselt_max(distance / self.line.len, 0.0), 1.0);
}

/// The part of a cell that counts.
struct LineCell {
    LineSegment part;
    float begin, end;  ///< shares of the length
    float first, last; ///< radiance there
};

LineCell line_cells_cell(const LineCells self, int k) {
    float low = line_profile_border(self.profile, k);
    float high = line_profile_border(self.profile, k + 1);
    float begin = nusselt_min(nusselt_max(low, self.lit.x), high);
    float end = nusselt_max(nusselt_min(high, self.lit.y), begin);
    vec2 share = (vec2(begin, end) - low) / (high - low);
    vec2 value = (vec2(1.0) - share) * line_profile_value(self.profile, k) +
                 share * line_profile_value(self.profile, k + 1);
    return LineCell(LineSegment(line_cells_point_at(self, begin), self.line.s, self.line.len * (end - begin)), begin, end,
                    value.x, value.y);
}

/// The number of the cell where samples at a point come from.
int line_cells_cell_at(const LineCells self, float at) {
    return line_profile_cell_at(self.profile, nusselt_min(nusselt_max(at, self.lit.x), self.lit.y));
}

/// A cell and the random number of the technique there.
struct LineSpot {
    LineCell cell;
    float x;
};

/// The spot for a random number. \param u in [0, 1)
LineSpot line_cells_spot_of(const LineCells self, float u) {
    float target = below_one(u) * self.total;
    LineSums sums = line_cells_sums(self, target, line_profile_cells(self.profile) - 1);
    LineCell cell = line_cells_cell(self, sums.cell);
    float rest = below_one((target - sums.before) / nusselt_max(sums.weight, kNusseltSmallestNormal));
    // Invert the distribution of a density that is linear in x.
    float both = cell.first + cell.last;
    float root = sqrt(nusselt_max(cell.first * cell.first + rest * (cell.last - cell.first) * both, 0.0));
    return LineSpot(cell, below_one(rest * both / nusselt_max(cell.first + root, kNusseltSmallestNormal)));
}

/// The density at a point of a cell: the measure of the cell cancels.
/// \param x         random number of the technique for the cell
/// \param integrand of the measure: density of that technique times its measure
float line_cells_density(const LineCells self, const LineCell cell, float x, float integrand) {
    if (!(cell.first + cell.last > 0.0)) return 0.0;
    float density = ((1.0 - x) * cell.first + x * cell.last) * integrand / self.total;
    return is_finite(density) ? density : 0.0;
}

/// \param s       a sample of the technique for the cell, in units of the scaled line
/// \param measure of that technique
TexturedSample line_cells_sample(const LineCells self, const LineSpot spot, const LightSample s, float measure) {
    float at = nusselt_min(nusselt_max(line_cells_position_of(self, s.wi), spot.cell.begin), spot.cell.end);
    return TexturedSample(s.wi, line_cells_density(self, spot.cell, spot.x, measure * s.pdf),
                          self.inverse_scale * s.p, vec2(at, 0.0));
}

/// The random number of a point in a cell.
/// \param sums up to the cell
/// \param x    random number of the technique for the cell
float line_cells_united(const LineCells self, const LineSums sums, const LineCell cell, float x) {
    float both = cell.first + cell.last;
    float below = x * (2.0 * cell.first + x * (cell.last - cell.first));
    float rest = both > 0.0 ? nusselt_min(below / both, 1.0) : 0.0;
    return below_one((sums.before + rest * sums.weight) / self.total);
}

#endif
