#ifndef NUSSELT_EMISSION_ENVIRONMENT_MAP_GLSL
#define NUSSELT_EMISSION_ENVIRONMENT_MAP_GLSL
// Follows include/nusselt/emission/environment_map.h @ 438c227aae64
// Follows include/nusselt/emission/environment_map_words.h @ f237a5545f0e
/// What sampling needs to know about an environment map, from its texels and from the words that EnvironmentMapWords of
/// C++ writes once per map. Twin of include/nusselt/emission/environment_map.h and environment_map_words.h.
///
/// Both are in buffers or textures of the program, which says how to fetch them: it defines the functions
/// environment_map_word() and environment_map_texel(), before or after the #include. For instance, for one map:
///
///     layout(set = 0, binding = 3, std430) readonly buffer MapWords { uint words[]; };
///     uint environment_map_word(uint at) { return words[at]; }
///     layout(set = 0, binding = 4) uniform sampler2D texels;
///     vec3 environment_map_texel(uint map, ivec2 at) { return texelFetch(texels, at, 0).rgb; }
///
/// A map is known by the number of its first word. Texels have to be those that C++ prepared the map from.

#include "../core/real.glsl"
#include "../emission/bilinear_texel.glsl"
#include "../emission/octahedral_map.glsl"
#include "../emission/textured_sample.glsl"

/// Word number `at` of all maps.
uint environment_map_word(uint at);
/// Radiance per channel [W/(sr m^2)] of the texel in this column and row, from 0 to environment_map_size() - 1.
/// \param map first word.
vec3 environment_map_texel(uint map, ivec2 at);

// Where the parts of a map begin: those of EnvironmentMapWords in C++.
const uint kNusseltMapSize = 0u;
const uint kNusseltMapLevels = 1u;
const uint kNusseltMapScale = 2u;
const uint kNusseltMapTexelVariance = 3u;
const uint kNusseltMapGrids = 4u;
const uint kNusseltMapCells = 20u;

float environment_map_float(uint at) { return uintBitsToFloat(environment_map_word(at)); }
vec4 environment_map_vec4(uint at) {
    return vec4(environment_map_float(at), environment_map_float(at + 1u), environment_map_float(at + 2u),
                environment_map_float(at + 3u));
}

/// Columns and rows of texels, a power of two.
int environment_map_size(uint map) { return int(environment_map_word(map + kNusseltMapSize)); }
/// Number of grids; the last one is the lattice.
int environment_map_levels(uint map) { return int(environment_map_word(map + kNusseltMapLevels)); }
/// A power of two, in weights: the brightest texel has a weight of order one.
float environment_map_scale(uint map) { return environment_map_float(map + kNusseltMapScale); }

/// Four elements of a grid: the parts (0, 0), (1, 0), (0, 1), (1, 1) of an element of the next grid, or neighbouring
/// cells of a row.
struct EnvironmentElements {
    vec4 weight;   ///< mean radiance, averaged over channels, times the scale
    vec4 x, y, z;  ///< mean directions, weighted by radiance: shorter than one
    vec4 variance; ///< of directions, per axis
};

EnvironmentElements environment_map_elements(uint map, uint begin) {
    EnvironmentElements four;
    four.weight = environment_map_vec4(begin);
    four.x = environment_map_vec4(begin + 4u);
    four.y = environment_map_vec4(begin + 8u);
    four.z = environment_map_vec4(begin + 12u);
    // From the length of the mean direction.
    vec4 rest = vec4(1.0) - (four.x * four.x + four.y * four.y + four.z * four.z);
    float of_texel = environment_map_float(map + kNusseltMapTexelVariance);
    four.variance = vec4(nusselt_fma(1.0 / 3.0, nusselt_max(rest.x, 0.0), of_texel),
                         nusselt_fma(1.0 / 3.0, nusselt_max(rest.y, 0.0), of_texel),
                         nusselt_fma(1.0 / 3.0, nusselt_max(rest.z, 0.0), of_texel),
                         nusselt_fma(1.0 / 3.0, nusselt_max(rest.w, 0.0), of_texel));
    return four;
}

/// Where the words of four cells of a row begin.
/// \param cell index of the first one, a multiple of 4.
uint environment_map_cells_begin(uint map, int cell) { return map + kNusseltMapCells + 7u * uint(cell); }
EnvironmentElements environment_map_cells(uint map, int cell) {
    return environment_map_elements(map, environment_map_cells_begin(map, cell));
}
/// Mean radiance of four cells in one channel [W/(sr m^2)].
vec4 environment_map_cell_means(uint map, int cell, int channel) {
    return environment_map_vec4(environment_map_cells_begin(map, cell) + 16u + 4u * uint(channel));
}

/// The number of an element in its grid.
uint environment_map_element_index(uint map, int level, ivec2 at) {
    return uint(at.y * (environment_map_size(map) >> level) + at.x);
}
uint environment_map_grid(uint map, int level) {
    return map + environment_map_word(map + kNusseltMapGrids + uint(level));
}
/// The parts of an element of grid 2 and above.
EnvironmentElements environment_map_parts(uint map, int level, ivec2 at) {
    return environment_map_elements(
        map, environment_map_grid(map, level) + 16u * environment_map_element_index(map, level, at));
}
/// The weights of the texels of an element of grid 1.
vec4 environment_map_texel_weights(uint map, ivec2 at) {
    return environment_map_vec4(environment_map_grid(map, 1) + 4u * environment_map_element_index(map, 1, at));
}
float environment_map_texel_weight(uint map, ivec2 texel) {
    return environment_map_float(environment_map_grid(map, 1) +
                                 4u * environment_map_element_index(map, 1, texel >> 1) +
                                 uint(2 * (texel.y & 1) + (texel.x & 1)));
}

/// The texel at an index that may lie one texel beyond the map.
vec3 environment_map_wrapped_texel(uint map, ivec2 at) {
    return environment_map_texel(map, wrap_octahedral(at, environment_map_size(map)));
}
/// Three texels of a row, averaged over channels.
vec3 environment_map_row(uint map, ivec2 middle) {
    return vec3(mean_of_channels(environment_map_wrapped_texel(map, middle - ivec2(1, 0))),
                mean_of_channels(environment_map_wrapped_texel(map, middle)),
                mean_of_channels(environment_map_wrapped_texel(map, middle + ivec2(1, 0))));
}
/// The interpolated lookups in a texel, averaged over channels.
BilinearTexel environment_map_interpolant(uint map, ivec2 texel) {
    return BilinearTexel(environment_map_row(map, texel - ivec2(0, 1)), environment_map_row(map, texel),
                         environment_map_row(map, texel + ivec2(0, 1)));
}

/// Radiance between the centres of texels [W/(sr m^2)], also across the edges of the map.
/// \param point of the map, in [0, 1]^2.
vec3 environment_map_lookup(uint map, vec2 point) {
    vec2 x = point * float(environment_map_size(map)) - 0.5;
    vec2 low = floor(x);
    vec2 share = x - low;
    ivec2 at = ivec2(low);
    vec3 below = (1.0 - share.x) * environment_map_wrapped_texel(map, at) +
                 share.x * environment_map_wrapped_texel(map, at + ivec2(1, 0));
    vec3 above = (1.0 - share.x) * environment_map_wrapped_texel(map, at + ivec2(0, 1)) +
                 share.x * environment_map_wrapped_texel(map, at + ivec2(1, 1));
    return (1.0 - share.y) * below + share.y * above;
}
/// \param w unit direction in the space of the map.
vec3 environment_map_lookup(uint map, vec3 w) { return environment_map_lookup(map, octahedral_coordinates(w)); }

#endif
