#ifndef NUSSELT_PASSES_LIGHTS_ENVIRONMENT_CELLS_GLSL
#define NUSSELT_PASSES_LIGHTS_ENVIRONMENT_CELLS_GLSL
/// The techniques for environments: radiance of the map times a measure, or the measure alone where radiance is the same
/// everywhere. What EnvironmentCosine and EnvironmentLtc share stands here once: drivers compile a second copy as long as the
/// first one.

#include "nusselt/emission/environment_cosine.glsl"
#include "nusselt/emission/environment_ltc.glsl"
#include "passes/lights/environment.glsl"

struct Sky {
    uint map; ///< first word, kNoWords for the same radiance everywhere
    Ltc lobe; ///< of technique 1
    // With a map only.
    EnvironmentLobe lobe_on_map;
    EnvironmentCells of_technique[2];
};

bool has_map(Sky sky) { return kHasMappedEnvironments && (!kHasUniformEnvironments || sky.map != kNoWords); }

/// About the mean cosines or densities of a lobe in four elements.
vec4 sky_factor(Sky sky, int technique, EnvironmentElements four) {
    if (technique == 1) return environment_ltc_factor(sky.lobe_on_map, four);
    return environment_cosine_factor(sky.of_technique[0].frame.n, four);
}

/// \param is_paired whether technique 1 is needed
Sky prepare_sky(uint index, Frame shading, Ltc lobe, bool is_paired) {
    Sky sky;
    sky.map = environment_lights[index].first_map_word;
    sky.lobe = lobe;
    if (!has_map(sky)) return sky;
    Frame frame =
        Frame(to_map_space(index, shading.t), to_map_space(index, shading.b), to_map_space(index, shading.n));
    if (is_paired) sky.lobe_on_map = environment_lobe_prepare(lobe, frame);
    sky.of_technique[0] = environment_cells_prepare(sky.map, frame, 0.0);
    sky.of_technique[1] = environment_cells_prepare(sky.map, frame, -kNusseltLargest);
    int count = is_paired ? 2 : 1;
    for (int k = 0; k < count; ++k) {
        for (int cell = 0; cell < kNusseltCells * kNusseltCells; cell += 4) {
            EnvironmentElements four = environment_map_cells(sky.map, cell);
            environment_cells_add(sky.of_technique[k], cell, four.weight, sky_factor(sky, k, four));
        }
        environment_cells_finish(sky.of_technique[k], k == 0 ? 1.0 / kNusseltPi : 1.0);
    }
    return sky;
}

/// The coefficients of heuristics per albedo.
vec3 cells_unshadowed(Sky sky, int technique) {
    return has_map(sky) ? sky.of_technique[technique].unshadowed : vec3(1.0);
}

#endif
