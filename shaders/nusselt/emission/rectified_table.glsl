#ifndef NUSSELT_EMISSION_RECTIFIED_TABLE_GLSL
#define NUSSELT_EMISSION_RECTIFIED_TABLE_GLSL
// Follows include/nusselt/emission/rectified_table.h @ 51acd585a765
/// Tables of radiance by direction, from the words that RectifiedTableWords of C++ writes once per table. Twin of
/// include/nusselt/emission/rectified_table.h, without what makes tables.
///
/// The words of tables and of the lights that show them are in a buffer or an integer texture of the program, in any
/// order. The program says how to fetch them: it defines the function windowed_light_word(), before or after the
/// #include. For instance:
///
///     layout(set = 0, binding = 3, std430) readonly buffer WindowedLights { uint words[]; };
///     uint windowed_light_word(uint at) { return words[at]; }
///
/// A table is known by the number of its first word. Sums are integers of 64 bits, pairs of words with the lower half
/// first: their differences are exact, and become floats only then.

#include "../core/vec.glsl"

/// Word number `at` of all tables and lights.
uint windowed_light_word(uint at);

// Where the parts of a table begin: those of RectifiedTableWords in C++.
const uint kNusseltTableWidth = 0u;
const uint kNusseltTableHeight = 1u;
const uint kNusseltTableDomainLow = 2u;
const uint kNusseltTableDomainHigh = 4u;
const uint kNusseltTableAngleLow = 6u;
const uint kNusseltTableTexelSize = 8u;
const uint kNusseltTableMean = 10u;
const uint kNusseltTableMeanSquare = 11u;
const uint kNusseltTableSums = 12u;

/// Slopes of directions next to the edge of a hemisphere, beyond which nothing is counted.
const float kNusseltLargestSlope = 4294967296.0; // 2^32
/// One over what sums add up to over a table.
const float kNusseltTableShare = 2.220446049250313e-16; // 2^-52
/// Halvings that find one of the 2048 columns or rows that a table may have.
const int kNusseltTableHalvings = 11;

float windowed_light_float(uint at) { return uintBitsToFloat(windowed_light_word(at)); }
vec2 windowed_light_vec2(uint at) { return vec2(windowed_light_float(at), windowed_light_float(at + 1u)); }
vec3 windowed_light_vec3(uint at) { return vec3(windowed_light_vec2(at), windowed_light_float(at + 2u)); }

/// Columns and rows of texels, along alpha and beta.
ivec2 rectified_table_size(uint table) {
    return ivec2(windowed_light_word(table + kNusseltTableWidth), windowed_light_word(table + kNusseltTableHeight));
}
/// The smallest slopes that the table covers.
vec2 rectified_table_domain_low(uint table) { return windowed_light_vec2(table + kNusseltTableDomainLow); }
vec2 rectified_table_domain_high(uint table) { return windowed_light_vec2(table + kNusseltTableDomainHigh); }
/// Alpha and beta of the smallest slopes [rad].
vec2 rectified_table_angle_low(uint table) { return windowed_light_vec2(table + kNusseltTableAngleLow); }
/// In alpha and beta [rad].
vec2 rectified_table_texel_size(uint table) { return windowed_light_vec2(table + kNusseltTableTexelSize); }
/// Over the solid angle of the domain and over channels [W/(sr m^2)]; 0: all of it is black.
float rectified_table_mean(uint table) { return windowed_light_float(table + kNusseltTableMean); }
/// Mean square of the radiance averaged over channels, over the squared mean: at least 1, or 0 if black.
float rectified_table_mean_square(uint table) { return windowed_light_float(table + kNusseltTableMeanSquare); }

/// Integers of 64 bits.
uvec2 difference_of_pairs(uvec2 a, uvec2 b) { return uvec2(a.x - b.x, a.y - b.y - (a.x < b.x ? 1u : 0u)); }
bool is_zero_pair(uvec2 x) { return (x.x | x.y) == 0u; }
/// Grows with the integer, in spite of rounding.
float pair_to_float(uvec2 x) {
    NUSSELT_PRECISE float result = float(x.y) * 4294967296.0 + float(x.x);
    return result;
}

// The quantities of RectifiedSums, by the word of an entry where each begins.
const uint kNusseltWeight = 0u;
const uint kNusseltSquare = 2u;
const uint kNusseltSolidAngle = 4u;

/// A quantity summed over all texels with columns below i and rows below j.
uvec2 rectified_table_below(uint table, uint quantity, int i, int j) {
    uint entry = uint(j) * (windowed_light_word(table + kNusseltTableWidth) + 1u) + uint(i);
    uint at = table + kNusseltTableSums + 6u * entry + quantity;
    return uvec2(windowed_light_word(at), windowed_light_word(at + 1u));
}

/// Texels from `begin` to before `end` along alpha and beta, none if these are equal.
struct TexelRectangle {
    ivec2 begin, end;
};

/// A quantity summed over texels: exact.
uvec2 rectified_table_sum(uint table, uint quantity, const TexelRectangle r) {
    uvec2 a = rectified_table_below(table, quantity, r.begin.x, r.begin.y);
    uvec2 b = rectified_table_below(table, quantity, r.end.x, r.begin.y);
    uvec2 c = rectified_table_below(table, quantity, r.begin.x, r.end.y);
    uvec2 d = rectified_table_below(table, quantity, r.end.x, r.end.y);
    return difference_of_pairs(difference_of_pairs(d, c), difference_of_pairs(b, a));
}
bool rectified_table_is_black(uint table, const TexelRectangle r) {
    return is_zero_pair(rectified_table_sum(table, kNusseltWeight, r));
}
float rectified_table_weight(uint table, const TexelRectangle r) {
    return pair_to_float(rectified_table_sum(table, kNusseltWeight, r));
}

/// Radiance per channel times solid angle [W/m^2], summed like the integers but with rounding errors.
vec3 rectified_table_colour_below(uint table, int i, int j) {
    ivec2 size = rectified_table_size(table);
    int entries = (size.x + 1) * (size.y + 1);
    return windowed_light_vec3(table + kNusseltTableSums + 6u * uint(entries) + 3u * uint(j * (size.x + 1) + i));
}

/// Solid angle per square radian of alpha and beta, for slopes within kNusseltLargestSlope.
float rectified_jacobian(float p, float q) {
    float squared = 1.0 + p * p + q * q;
    return ((1.0 + p * p) / squared) * ((1.0 + q * q) / sqrt(squared));
}

#endif
