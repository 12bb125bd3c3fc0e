#ifndef NUSSELT_PASSES_CELLS_LINE_CELLS_GLSL
#define NUSSELT_PASSES_CELLS_LINE_CELLS_GLSL
/// The techniques for radiance times a measure, of lights whose radiance varies along a line.

#include "nusselt/line_emission/textured_line.glsl"
#include "nusselt/line_emission/textured_line_ltc.glsl"
#include "passes/lights/line.glsl"

struct LineLightCells {
    LineCells of_technique[2];
    Ltc lobe; ///< of technique 1
};

/// Techniques take turns: two copies of the code would take twice as long to compile.
/// \param light     whose radiance varies
/// \param is_paired whether technique 1 is needed
LineLightCells prepare_cells(const LocalLine light, const Ltc lobe, bool is_paired) {
    float scale = scale_of(light.shape);
    LineSegment line = scaled(light.shape, scale);
    LineLightCells cells;
    cells.lobe = lobe;
    int count = is_paired ? 2 : 1;
    for (int k = 0; k < count; ++k) {
        LineSegment image = line;
        float ratio = 1.0;
        if (is_paired && k == 1) {
            image = to_cosine_space(line, lobe);
            ratio = textured_line_ltc_ratio(line, lobe);
        }
        cells.of_technique[k] = line_cells_prepare(line, image, ratio, scale, light.radiance.profile);
    }
    return cells;
}

vec3 cells_unshadowed(LineLightCells cells, int technique) {
    return (technique == 1 ? 1.0 : 1.0 / kNusseltPi) * cells.of_technique[technique].expected;
}

#endif
