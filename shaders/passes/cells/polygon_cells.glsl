#ifndef NUSSELT_PASSES_CELLS_POLYGON_CELLS_GLSL
#define NUSSELT_PASSES_CELLS_POLYGON_CELLS_GLSL
/// The techniques for radiance times a measure, of polygonal lights that emit an image.

#include "nusselt/emission/textured_polygon.glsl"
#include "nusselt/emission/textured_polygon_ltc.glsl"
#include "passes/lights/polygon.glsl"

uint textured_light_word(uint at) { return emission_words[at]; }

/// Not an array of two techniques: drivers would copy it, with all of its sums, for each index that varies.
struct PolygonCells {
    int texture_number;
    TexturedCells diffuse;  ///< of technique 0
    TexturedCells specular; ///< of technique 1
    Ltc lobe;               ///< of technique 1
};

/// Techniques take turns: two copies of the code would take twice as long to compile.
/// \param light     with a texture
/// \param is_paired whether technique 1 is needed
PolygonCells prepare_cells(const LocalPolygon light, const Ltc lobe, bool is_paired) {
    uint first_word = polygon_textures[light.texture_number].first_word;
    PolygonCells cells;
    cells.texture_number = light.texture_number;
    cells.lobe = lobe;
    int count = is_paired ? 2 : 1;
    for (int k = 0; k < count; ++k) {
        TexturedView view = textured_polygon_view(light.plane, first_word);
        if (is_paired && k == 1) view = textured_polygon_ltc_view(light.plane, first_word, lobe);
        TexturedCells prepared = textured_cells_prepare(view);
        if (k == 1)
            cells.specular = prepared;
        else
            cells.diffuse = prepared;
    }
    return cells;
}

vec3 cells_unshadowed(const PolygonCells cells, int technique) {
    if (technique == 1) return textured_cells_unshadowed(cells.specular);
    return textured_cells_unshadowed(cells.diffuse);
}

#endif
