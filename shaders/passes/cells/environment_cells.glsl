#ifndef NUSSELT_PASSES_CELLS_ENVIRONMENT_CELLS_GLSL
#define NUSSELT_PASSES_CELLS_ENVIRONMENT_CELLS_GLSL
/// The techniques for environments: radiance of the map times a measure, or the measure alone where radiance is the same
/// everywhere. Descents to texels, which EnvironmentCosine and EnvironmentLtc share, are compiled once, but indices of arrays of
/// sums are constant: drivers would copy these arrays otherwise.

#include "nusselt/emission/environment_cosine.glsl"
#include "nusselt/emission/environment_ltc.glsl"
#include "passes/lights/environment.glsl"

struct Sky {
    uint map; ///< first word, kNoWords for the same radiance everywhere
    Ltc lobe; ///< of technique 1
    // With a map only.
    EnvironmentLobe lobe_on_map;
    EnvironmentCells diffuse;  ///< of technique 0
    EnvironmentCells specular; ///< of technique 1
};

bool has_map(const Sky sky) { return kHasMappedEnvironments && (!kHasUniformEnvironments || sky.map != kNoWords); }

/// \param is_paired whether technique 1 is needed
Sky prepare_sky(uint index, const Frame shading, const Ltc lobe, bool is_paired) {
    Sky sky;
    sky.map = environment_lights[index].first_map_word;
    sky.lobe = lobe;
    if (!has_map(sky)) return sky;
    Frame frame =
        Frame(to_map_space(index, shading.t), to_map_space(index, shading.b), to_map_space(index, shading.n));
    sky.diffuse = environment_cells_prepare(sky.map, frame, 0.0);
    sky.specular = environment_cells_prepare(sky.map, frame, -kNusseltLargest);
    if (is_paired) sky.lobe_on_map = environment_lobe_prepare(lobe, frame);
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; cell += 4) {
        EnvironmentElements four = environment_map_cells(sky.map, cell);
        environment_cells_add(sky.diffuse, cell, four.weight, environment_cosine_factor(frame.n, four));
        if (is_paired)
            environment_cells_add(sky.specular, cell, four.weight, environment_ltc_factor(sky.lobe_on_map, four));
    }
    environment_cells_finish(sky.diffuse, 1.0 / kNusseltPi);
    if (is_paired) environment_cells_finish(sky.specular, 1.0);
    return sky;
}

/// The coefficients of heuristics per albedo.
vec3 cells_unshadowed(const Sky sky, int technique) {
    if (!has_map(sky)) return vec3(1.0);
    return technique == 1 ? sky.specular.unshadowed : sky.diffuse.unshadowed;
}

#endif
