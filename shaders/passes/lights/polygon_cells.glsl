#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_CELLS_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_CELLS_GLSL
/// The techniques for radiance times a measure, of polygonal lights that emit an image.

#include "nusselt/emission/textured_polygon.glsl"
#include "nusselt/emission/textured_polygon_ltc.glsl"
#include "passes/lights/polygon.glsl"

uint textured_light_word(uint at) { return emission_words[at]; }

struct PolygonCells {
    int texture_number;
    TexturedCells of_technique[2];
    Ltc lobe; ///< of technique 1
};

/// Techniques take turns: two copies of the code would take twice as long to compile.
/// \param light     with a texture
/// \param is_paired whether technique 1 is needed
PolygonCells prepare_cells(LocalPolygon light, Ltc lobe, bool is_paired) {
    uint first_word = polygon_textures[light.texture_number].first_word;
    PolygonCells cells;
    cells.texture_number = light.texture_number;
    cells.lobe = lobe;
    int count = is_paired ? 2 : 1;
    for (int k = 0; k < count; ++k) {
        TexturedView view = textured_polygon_view(light.plane, first_word);
        if (is_paired && k == 1) view = textured_polygon_ltc_view(light.plane, first_word, lobe);
        cells.of_technique[k] = textured_cells_prepare(view);
    }
    return cells;
}

vec3 cells_unshadowed(PolygonCells cells, int technique) {
    return textured_cells_unshadowed(cells.of_technique[technique]);
}

#endif
