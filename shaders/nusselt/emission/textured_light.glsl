#ifndef NUSSELT_EMISSION_TEXTURED_LIGHT_GLSL
#define NUSSELT_EMISSION_TEXTURED_LIGHT_GLSL
// Follows include/nusselt/emission/textured_light.h @ 6905f8c26fe6
// Follows include/nusselt/emission/textured_light_words.h @ 1f30388c693b
// Follows include/nusselt/emission/texture_pyramid.h @ fb50e6db8c69
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
#include "../emission/texture_plane.glsl"
#include "../geometry/convex_polygon.glsl"

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

/// A rectangle of the texture.
struct TextureRectangle {
    vec2 low, high;
};

/// Whether all of a rectangle is inside of the outline.
bool textured_light_contains(uint light, TextureRectangle rectangle) {
    int count = textured_light_vertices(light);
    bool inside = true;
    for (int k = 0; k < count; ++k) {
        vec2 begin = textured_light_vertex(light, k);
        vec2 along = textured_light_end_of(light, k) - begin;
        vec2 outermost = vec2(along.y > 0.0 ? rectangle.high.x : rectangle.low.x,
                              along.x > 0.0 ? rectangle.low.y : rectangle.high.y);
        inside = inside && det(along, outermost - begin) >= 0.0;
    }
    return inside;
}

const int kNusseltMostCorners = 12;

/// A convex part of a texture.
struct TexturePart {
    vec2 corner[kNusseltMostCorners]; ///< texture coordinates, counter-clockwise
    int count;                        ///< 0 or at least 3
};

TexturePart texture_part_of(TextureRectangle rectangle) {
    TexturePart part;
    part.corner[0] = rectangle.low;
    part.corner[1] = vec2(rectangle.high.x, rectangle.low.y);
    part.corner[2] = rectangle.high;
    part.corner[3] = vec2(rectangle.low.x, rectangle.high.y);
    for (int k = 4; k < kNusseltMostCorners; ++k) part.corner[k] = rectangle.low;
    part.count = 4;
    return part;
}

/// Share of the texture.
float texture_part_area(TexturePart self) {
    float doubled = 0.0;
    for (int k = 2; k < self.count; ++k)
        doubled = doubled + nusselt_max(det(self.corner[k - 1] - self.corner[0], self.corner[k] - self.corner[0]), 0.0);
    return 0.5 * doubled;
}

/// The part where the product of a coordinate with a sign is at least that of the limit.
/// \param axis 0 for x, 1 for y.
TexturePart texture_part_cut(TexturePart whole, int axis, float sign_of_side, float limit) {
    TexturePart result = whole;
    result.count = 0;
    for (int k = 0; k < whole.count; ++k) {
        vec2 a = whole.corner[k];
        vec2 b = whole.corner[k + 1 < whole.count ? k + 1 : 0];
        float from = sign_of_side * ((axis == 0 ? a.x : a.y) - limit);
        float to = sign_of_side * ((axis == 0 ? b.x : b.y) - limit);
        if (from >= 0.0 && result.count < kNusseltMostCorners) {
            result.corner[result.count] = a;
            ++result.count;
        }
        if (((from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0)) && result.count < kNusseltMostCorners) {
            vec2 crossing = a + (from / (from - to)) * (b - a);
            result.corner[result.count] = axis == 0 ? vec2(limit, crossing.y) : vec2(crossing.x, limit);
            ++result.count;
        }
    }
    if (result.count < 3) result.count = 0;
    return result;
}

/// The part of a rectangle inside of the outline.
TexturePart textured_light_part_in(uint light, TextureRectangle rectangle) {
    TexturePart part;
    part.count = textured_light_vertices(light);
    for (int k = 0; k < kNusseltMostCorners; ++k)
        part.corner[k] = textured_light_vertex(light, k < part.count ? k : 0);
    for (int side = 0; side < 4; ++side) {
        int axis = side >> 1;
        bool is_low = (side & 1) == 0;
        vec2 limit = is_low ? rectangle.low : rectangle.high;
        part = texture_part_cut(part, axis, is_low ? 1.0 : -1.0, axis == 0 ? limit.x : limit.y);
    }
    return part;
}

/// A uniform point of a part: the triangle of a fan by u.x, as in PolygonArea.
vec2 texture_part_sample(TexturePart self, vec2 u) {
    vec2 corner = self.corner[0];
    float rest = u.x * 2.0 * texture_part_area(self);
    vec2 a = vec2(0.0);
    vec2 b = vec2(0.0);
    float along = 0.0;
    for (int k = 2; k < self.count; ++k) {
        vec2 from = self.corner[k - 1] - corner;
        vec2 to = self.corner[k] - corner;
        float doubled = det(from, to);
        if (doubled > 0.0 && !(rest < 0.0)) {
            a = from;
            b = to;
            along = nusselt_min(rest / doubled, 1.0);
            rest = rest < doubled ? -1.0 : rest - doubled;
        }
    }
    float root = sqrt(u.y);
    return corner + (root * (1.0 - along)) * a + (root * along) * b;
}

/// What texture_part_sample() undoes.
vec2 texture_part_invert(TexturePart self, vec2 at) {
    vec2 q = at - self.corner[0];
    float total = 2.0 * texture_part_area(self);
    float before = 0.0;
    vec2 u = vec2(0.0);
    for (int k = 2; k < self.count; ++k) {
        vec2 from = self.corner[k - 1] - self.corner[0];
        vec2 to = self.corner[k] - self.corner[0];
        float doubled = det(from, to);
        if (!(doubled > 0.0)) continue;
        float towards_from = nusselt_max(det(q, to) / doubled, 0.0);
        float towards_to = nusselt_max(det(from, q) / doubled, 0.0);
        float sum = towards_from + towards_to;
        u = vec2(below_one((before + (sum > 0.0 ? towards_to / sum : 0.0) * doubled) / total), below_one(sum * sum));
        if (towards_from > 0.0) break;
        before = before + doubled;
    }
    return u;
}

/// A part in space. Of a part with more than NUSSELT_MAX_VERTICES corners, it has the first ones: TexturedLightWords
/// makes sure that nobody asks for those.
ConvexPolygon polygon_in(TexturePlane plane, TexturePart part) {
    vec3 vertices[NUSSELT_MAX_VERTICES];
    vec3 edges[NUSSELT_MAX_VERTICES];
    vec2 from = part.corner[0];
    NUSSELT_UNROLL for (int k = 0; k < NUSSELT_MAX_VERTICES; ++k) {
        vec2 to = part.corner[0];
        if (k + 1 < NUSSELT_MAX_VERTICES) to = k + 1 < part.count ? part.corner[k + 1] : from;
        vertices[k] = texture_plane_point_at(plane, from);
        edges[k] = texture_plane_offset_of(plane, to - from);
        from = to;
    }
    return make_polygon(vertices, edges, plane.normal);
}

/// All of the texture, a parallelogram in space.
ConvexPolygon texture_plane_outline(TexturePlane plane) {
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
ivec2 pyramid_size_of(PyramidShape self, int level) {
    return max(ivec2(1 << max(self.width_log2 - level, 0), 1 << max(self.height_log2 - level, 0)),
               ivec2(kNusseltCells));
}

/// Columns and rows of the grid before that make one column and row of a grid: 1 or 2 each.
ivec2 pyramid_parts_of(PyramidShape self, int level) {
    return pyramid_size_of(self, level - 1) / pyramid_size_of(self, level);
}

#endif
