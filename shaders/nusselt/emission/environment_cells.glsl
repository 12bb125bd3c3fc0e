#ifndef NUSSELT_EMISSION_ENVIRONMENT_CELLS_GLSL
#define NUSSELT_EMISSION_ENVIRONMENT_CELLS_GLSL
// Follows include/nusselt/emission/environment_sampling.h @ 5ca2cddb10f4
/// What EnvironmentCosine and EnvironmentLtc share: sums over cells, and points in texels. Twin of EnvironmentSampler
/// in include/nusselt/emission/environment_sampling.h, with 8 x 8 cells.

#include "../core/frame.glsl"
#include "../emission/cell_sums.glsl"
#include "../emission/environment_map.glsl"

/// Where p is on rays to the environment [m]: its square is in the range of float.
const float kNusseltEnvironmentDistance = 1152921504606846976.0; // 2^60

/// An environment as seen from a shading point.
struct EnvironmentCells {
    uint map;        ///< first word
    Frame frame;     ///< of the shading point, in the space of the map
    float lowest;    ///< samples count above this z
    CellSums sums;
    vec3 unshadowed; ///< the radiance that is reflected without shadows per albedo, per channel [W/(sr m^2)]
};

EnvironmentCells environment_cells_prepare(uint map, const Frame frame, float lowest) {
    EnvironmentCells self;
    self.map = map;
    self.frame = frame;
    self.lowest = lowest;
    self.sums.total = 0.0;
    self.unshadowed = vec3(0.0);
    return self;
}

/// Solid angle of a cell [sr].
const float kNusseltCellAngle = 4.0 * kNusseltPi / float(kNusseltCells * kNusseltCells);

/// Appends four cells.
/// \param factor mean cosines or lobes.
void environment_cells_add(inout EnvironmentCells self, int cell, vec4 weight, vec4 factor) {
    vec4 product = weight * factor;
    cell_sums_add(self.sums, cell, product.x);
    cell_sums_add(self.sums, cell + 1, product.y);
    cell_sums_add(self.sums, cell + 2, product.z);
    cell_sums_add(self.sums, cell + 3, product.w);
    self.unshadowed = self.unshadowed + vec3(dot(environment_map_cell_means(self.map, cell, 0), factor),
                                             dot(environment_map_cell_means(self.map, cell, 1), factor),
                                             dot(environment_map_cell_means(self.map, cell, 2), factor));
}

/// After the last cells.
/// \param per_albedo reflected radiance over measure.
void environment_cells_finish(inout EnvironmentCells self, float per_albedo) {
    cell_sums_finish(self.sums);
    self.unshadowed = (per_albedo * kNusseltCellAngle) * self.unshadowed;
}

/// An estimate of the integral of radiance, averaged over channels, times the factor.
float environment_cells_measure(const EnvironmentCells self) {
    return kNusseltCellAngle * (self.sums.total / environment_map_scale(self.map));
}

/// The coordinate of a point of texel i. It never rounds to the next texel.
float environment_cells_position(int i, float inside, float step_size) {
    const float below = 0.999999940395355224609375;
    return nusselt_min((float(i) + inside) * step_size, below * (float(i + 1) * step_size));
}

/// The position of a point in its texel.
vec2 environment_cells_inside(const EnvironmentCells self, ivec2 texel, vec2 at) {
    return at * float(environment_map_size(self.map)) - vec2(texel);
}

/// The texel of a point.
/// \param at in [0, 1)^2.
TexelChoice environment_cells_texel_at(const EnvironmentCells self, vec2 at) {
    int size = environment_map_size(self.map);
    return TexelChoice(clamp(ivec2(at * float(size)), ivec2(0), ivec2(size - 1)), 1.0, vec2(0.0));
}

/// The density of a point in a texel with this probability [1/sr].
/// \param wi the direction of the point.
float environment_cells_density(const EnvironmentCells self, float probability, ivec2 texel,
                                const BilinearTexel interpolant,
                                vec2 at, vec3 wi) {
    float mean = environment_map_texel_weight(self.map, texel);
    if (!(mean > 0.0) || !(wi.z > self.lowest)) return 0.0;
    float size = float(environment_map_size(self.map));
    float value = bilinear_texel_at(interpolant, environment_cells_inside(self, texel, at));
    float share = environment_map_scale(self.map) * value / mean;
    return probability * share * (size * size / (4.0 * kNusseltPi));
}

/// The sample in a texel.
/// \param texel with the random numbers that are left.
TexturedSample environment_cells_sample(const EnvironmentCells self, const CellChoice cell, const TexelChoice texel) {
    float step_size = reciprocal_power_of_two(float(environment_map_size(self.map)));
    BilinearTexel interpolant = environment_map_interpolant(self.map, texel.at);
    vec2 inside = bilinear_texel_sample(interpolant, texel.u);
    vec2 at = vec2(environment_cells_position(texel.at.x, inside.x, step_size),
                   environment_cells_position(texel.at.y, inside.y, step_size));
    vec3 wi = frame_to_local(self.frame, octahedral_direction(at));
    float density =
        environment_cells_density(self, cell.probability * texel.probability, texel.at, interpolant, at, wi);
    return TexturedSample(wi, density, kNusseltEnvironmentDistance * wi, at);
}

#endif
