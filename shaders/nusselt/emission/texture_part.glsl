#ifndef NUSSELT_EMISSION_TEXTURE_PART_GLSL
#define NUSSELT_EMISSION_TEXTURE_PART_GLSL
// Follows include/nusselt/emission/textured_light.h @ 6905f8c26fe6
/// Convex parts of a texture, and how outlines cut rectangles. Twin of TexturePart and of what TextureOutline computes
/// in include/nusselt/emission/textured_light.h.

#include "../emission/texture_plane.glsl"
#include "../geometry/convex_polygon.glsl"

/// A rectangle of the texture.
struct TextureRectangle {
    vec2 low, high;
};

/// Whether all of a rectangle is on the inner side of an edge of an outline.
bool is_inside_of_edge(vec2 begin, vec2 end, const TextureRectangle rectangle) {
    vec2 along = end - begin;
    vec2 outermost = vec2(along.y > 0.0 ? rectangle.high.x : rectangle.low.x,
                          along.x > 0.0 ? rectangle.low.y : rectangle.high.y);
    return det(along, outermost - begin) >= 0.0;
}

const int kNusseltMostCorners = 12;

/// A convex part of a texture.
struct TexturePart {
    vec2 corner[kNusseltMostCorners]; ///< texture coordinates, counter-clockwise
    int count;                        ///< 0 or at least 3
};

TexturePart texture_part_of(const TextureRectangle rectangle) {
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

/// The part of an outline inside of a rectangle.
TexturePart texture_part_in(const TexturePart outline, const TextureRectangle rectangle) {
    TexturePart part = outline;
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

/// A part in space. Of a part with more than NUSSELT_MAX_VERTICES corners, it has the first ones: samples of such
/// parts go to texels.
ConvexPolygon polygon_in(const TexturePlane plane, TexturePart part) {
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

#endif
