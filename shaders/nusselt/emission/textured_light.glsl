#ifndef NUSSELT_EMISSION_TEXTURED_LIGHT_GLSL
#define NUSSELT_EMISSION_TEXTURED_LIGHT_GLSL
// Follows include/nusselt/emission/textured_light.h @ 6905f8c26fe6
// Follows include/nusselt/emission/textured_light_words.h @ 1f30388c693b
// Follows include/nusselt/emission/texture_pyramid.h @ 7949c5c6567f
/// What sampling needs to know about a polygon with a texture, from the words that TexturedLightWords of C++ writes
/// once per light. Twin of include/nusselt/emission/textured_light.h, texture_pyramid.h and textured_light_words.h.
///
/// The words are in a buffer or an integer texture of the program, any number of lights one after another. The program
/// says how to fetch them: it defines the function textured_light_word(), before or after the #include. For instance:
///
///     layout(set = 0, binding = 3, std430) readonly buffer TexturedLights { uint words[]; };
///     uint textured_light_word(uint at) { return words[at]; }
///
/// A light is known by the number of its first word.

#include "../emission/cell_sums.glsl"
#include "../emission/texture_part.glsl"

/// Word number `at` of all lights.
uint textured_light_word(uint at);

// Where the parts of a light begin: those of TexturedLightWords in C++.
const uint kNusseltWidthLog2 = 0u;
const uint kNusseltHeightLog2 = 1u;
const uint kNusseltLevels = 2u;
const uint kNusseltVertices = 3u;
const uint kNusseltPieces = 4u;
const uint kNusseltGrids = 5u;
const uint kNusseltOutline = 21u;
const uint kNusseltColumnLines = 37u;
const uint kNusseltRowLines = 55u;
const uint kNusseltCellList = 73u;
const uint kNusseltPieceList = 457u;

float textured_light_float(uint at) { return uintBitsToFloat(textured_light_word(at)); }
vec2 textured_light_vec2(uint at) { return vec2(textured_light_float(at), textured_light_float(at + 1u)); }

uint textured_light_cell(uint light, int cell) { return light + kNusseltCellList + 6u * uint(cell); }
/// Mean over channels of the mean radiance of a cell [W/(sr m^2)]; 0 only if all of it is black.
float textured_light_weight(uint light, int cell) { return textured_light_float(textured_light_cell(light, cell)); }
/// Mean radiance of a cell [W/(sr m^2)].
vec3 textured_light_mean(uint light, int cell) {
    uint at = textured_light_cell(light, cell) + 1u;
    return vec3(textured_light_float(at), textured_light_float(at + 1u), textured_light_float(at + 2u));
}
/// Squared coefficient of variation of the weights of the texels of a cell.
float textured_light_variation(uint light, int cell) {
    return textured_light_float(textured_light_cell(light, cell) + 4u);
}
/// The share of a cell inside of the outline: 1 exactly if all of it is.
float textured_light_cover(uint light, int cell) { return textured_light_float(textured_light_cell(light, cell) + 5u); }

/// The interval of the line x = i / 8 that is inside of the outline; equal ends if it misses the outline.
vec2 textured_light_column_line(uint light, int i) {
    return textured_light_vec2(light + kNusseltColumnLines + 2u * uint(i));
}
/// Likewise for y = i / 8.
vec2 textured_light_row_line(uint light, int i) {
    return textured_light_vec2(light + kNusseltRowLines + 2u * uint(i));
}

/// A piece of the outline inside of one cell.
struct OutlinePiece {
    int cell, edge;
    vec2 interval; ///< positions along the edge, from 0 to 1
};

int textured_light_pieces(uint light) { return int(textured_light_word(light + kNusseltPieces)); }
OutlinePiece textured_light_piece(uint light, int k) {
    uint at = light + kNusseltPieceList + 4u * uint(k);
    return OutlinePiece(int(textured_light_word(at)), int(textured_light_word(at + 1u)), textured_light_vec2(at + 2u));
}

/// Number of vertices of the outline.
int textured_light_vertices(uint light) { return int(textured_light_word(light + kNusseltVertices)); }
/// Texture coordinates of a vertex, counter-clockwise.
vec2 textured_light_vertex(uint light, int k) { return textured_light_vec2(light + kNusseltOutline + 2u * uint(k)); }
/// The vertex where an edge ends.
vec2 textured_light_end_of(uint light, int edge) {
    return textured_light_vertex(light, edge + 1 < textured_light_vertices(light) ? edge + 1 : 0);
}

/// Whether all of a rectangle is inside of the outline.
bool textured_light_contains(uint light, const TextureRectangle rectangle) {
    int count = textured_light_vertices(light);
    bool inside = true;
    for (int k = 0; k < count; ++k)
        inside = inside &&
                 is_inside_of_edge(textured_light_vertex(light, k), textured_light_end_of(light, k), rectangle);
    return inside;
}

/// The part of a rectangle inside of the outline.
TexturePart textured_light_part_in(uint light, const TextureRectangle rectangle) {
    TexturePart part;
    part.count = textured_light_vertices(light);
    for (int k = 0; k < kNusseltMostCorners; ++k)
        part.corner[k] = textured_light_vertex(light, k < part.count ? k : 0);
    return texture_part_in(part, rectangle);
}

/// All of the texture, a parallelogram in space.
ConvexPolygon texture_plane_outline(const TexturePlane plane) {
    return polygon_in(plane, texture_part_of(TextureRectangle(vec2(0.0), vec2(1.0))));
}

/// The grids of a pyramid of means.
struct PyramidShape {
    int width_log2, height_log2; ///< of the finest grid
    int levels;                  ///< number of grids; the last one is the lattice
};

PyramidShape textured_light_shape(uint light) {
    return PyramidShape(int(textured_light_word(light + kNusseltWidthLog2)),
                        int(textured_light_word(light + kNusseltHeightLog2)),
                        int(textured_light_word(light + kNusseltLevels)));
}

/// Columns and rows of a grid.
ivec2 pyramid_size_of(const PyramidShape self, int level) {
    return max(ivec2(1 << max(self.width_log2 - level, 0), 1 << max(self.height_log2 - level, 0)),
               ivec2(kNusseltCells));
}

/// Columns and rows of the grid before that make one column and row of a grid: 1 or 2 each.
ivec2 pyramid_parts_of(const PyramidShape self, int level) {
    return pyramid_size_of(self, level - 1) / pyramid_size_of(self, level);
}

#endif
