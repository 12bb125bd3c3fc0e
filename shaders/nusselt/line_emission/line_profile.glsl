#ifndef NUSSELT_LINE_EMISSION_LINE_PROFILE_GLSL
#define NUSSELT_LINE_EMISSION_LINE_PROFILE_GLSL
// Follows include/nusselt/line_emission/line_profile.h @ f7f1111427b5
// Follows include/nusselt/line_emission/line_profile_words.h @ 67f720faaf8c
/// Radiance that varies along linear lights and tubes, from the words that LineProfileWords of C++ writes once per light. Twin of
/// include/nusselt/line_emission/line_profile.h and line_profile_words.h.
///
/// The words are in a buffer or an integer texture of the program, any number of profiles one after another. The program says
/// how to fetch them: it defines the function line_profile_word(), before or after the #include. For instance:
///
///     layout(set = 0, binding = 3, std430) readonly buffer LineProfiles { uint words[]; };
///     uint line_profile_word(uint at) { return words[at]; }
///
/// A profile is known by the number of its first word.

#include "../emission/textured_sample.glsl"
#include "../geometry/line_segment.glsl"

/// Word number `at` of all profiles.
uint line_profile_word(uint at);

/// The most cells of a profile: one more than there are texels.
const int kNusseltMostLineCells = 65;

// Where the parts of a profile begin: those of LineProfileWords in C++.
const uint kNusseltLineBorders = 1u;
const uint kNusseltWordsPerBorder = 5u;

int line_profile_cells(uint profile) { return int(line_profile_word(profile)); }

/// A number of the border where cell k begins.
float line_profile_float(uint profile, int k, uint number) {
    return uintBitsToFloat(
        line_profile_word(profile + kNusseltLineBorders + kNusseltWordsPerBorder * uint(k) + number));
}
/// Where cell k begins, from 0 to 1.
float line_profile_border(uint profile, int k) { return line_profile_float(profile, k, 0u); }
/// Integral of the values from 0 to the border.
float line_profile_before(uint profile, int k) { return line_profile_float(profile, k, 1u); }
/// Radiance at the border [W/(sr m^2)].
vec3 line_profile_radiance(uint profile, int k) {
    return vec3(line_profile_float(profile, k, 2u), line_profile_float(profile, k, 3u),
                line_profile_float(profile, k, 4u));
}
/// The same, averaged over channels.
float line_profile_value(uint profile, int k) { return mean_of_channels(line_profile_radiance(profile, k)); }

/// The share of a line before the point next to p, in [0, 1].
float place_along(const LineSegment line, vec3 p) {
    float at = dot(p - line.p0, line.s) / (line.len > 0.0 ? line.len : 1.0);
    // Comparisons with NaN are false.
    return at > 0.0 ? nusselt_min(at, 1.0) : 0.0;
}

/// The cell at a point. \param x in [0, 1]
int line_profile_cell_at(uint profile, float x) {
    int cells = line_profile_cells(profile);
    return clamp(int(floor(x * float(cells - 1) + 0.5)), 0, cells - 1);
}

/// Radiance at a point [W/(sr m^2)]. \param x in [0, 1]
vec3 line_profile_lookup(uint profile, float x) {
    int k = line_profile_cell_at(profile, x);
    float low = line_profile_border(profile, k);
    float share = (x - low) / (line_profile_border(profile, k + 1) - low);
    return (1.0 - share) * line_profile_radiance(profile, k) + share * line_profile_radiance(profile, k + 1);
}

/// The integral of radiance, averaged over channels, from 0 to a point; that to 1 is the mean. \param x in [0, 1]
float line_profile_below(uint profile, float x) {
    int k = line_profile_cell_at(profile, x);
    float low = line_profile_border(profile, k);
    float width = line_profile_border(profile, k + 1) - low;
    float share = (x - low) / width;
    float first = line_profile_value(profile, k);
    float last = line_profile_value(profile, k + 1);
    return line_profile_before(profile, k) + width * share * (first + 0.5 * share * (last - first));
}

#endif
