#ifndef NUSSELT_EMISSION_TEXTURED_CELLS_GLSL
#define NUSSELT_EMISSION_TEXTURED_CELLS_GLSL
// Follows include/nusselt/emission/textured_polygon.h @ 9805b2e0f56e
/// What TexturedPolygon and TexturedPolygonLtc share: they choose a cell in proportion to mean radiance times the
/// closed form of its measure, and take a texel of busy cells. Twin of include/nusselt/emission/textured_polygon.h,
/// with 8 x 8 cells and DescentByProduct.

#include "../core/light_sample.glsl"
#include "../emission/cell_descent.glsl"
#include "../emission/cell_lattice.glsl"
#include "../emission/cell_sums.glsl"
#include "../emission/texture_plane.glsl"
#include "../emission/textured_light.glsl"
#include "../emission/textured_sample.glsl"
#include "../geometry/polygon_measures.glsl"

/// A light with a texture as seen from a shading point.
struct TexturedView {
    uint light;         ///< first word
    TexturePlane plane; ///< scaled to coordinates of order one
    TexturePlane image; ///< in the space where the measure is the projected solid angle
    float image_area;
    float area;          ///< of the texture
    float distance;      ///< of its plane
    float inverse_scale; ///< a power of two
    float lowest;        ///< samples of texels count above this z
};

struct TexturedCells {
    TexturedView view;
    CellSums sums;   ///< without light, their total is 0
    vec3 unshadowed; ///< sum of mean radiance times projected solid angle
};

/// A light whose plane is also its image.
/// \param plane in shading space [m].
/// \param light first word.
TexturedView textured_view_prepare(const TexturePlane plane, uint light) {
    TexturedView self;
    self.light = light;
    vec3 reach = nusselt_max(abs(plane.corner), abs(texture_plane_point_at(plane, vec2(1.0, 0.0))));
    reach = nusselt_max(reach, abs(texture_plane_point_at(plane, vec2(1.0))));
    reach = nusselt_max(reach, abs(texture_plane_point_at(plane, vec2(0.0, 1.0))));
    float scale = reciprocal_power_of_two(largest_component(reach));
    self.inverse_scale = reciprocal_power_of_two(scale);
    self.plane =
        TexturePlane(without_tiny(scale * plane.corner), scale * plane.side_x, scale * plane.side_y, plane.normal);
    self.image = self.plane;
    self.image_area = texture_plane_area(self.plane);
    self.area = self.image_area;
    self.distance = 0.0;
    self.lowest = 0.0;
    return self;
}

/// Adds up the weights of cells along columns.
TexturedCells textured_cells_prepare(const TexturedView view) {
    TexturedCells self;
    self.view = view;
    self.unshadowed = vec3(0.0);
    cell_lattice_find_angles(cell_lattice_prepare(view.image, view.light), self.sums.sum);
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; ++cell) {
        float angle = self.sums.sum[cell];
        cell_sums_add(self.sums, cell, textured_light_weight(view.light, cell) * angle);
        self.unshadowed = nusselt_fma(angle, textured_light_mean(view.light, cell), self.unshadowed);
    }
    cell_sums_finish(self.sums);
    if (!(view.image_area > 0.0 && view.distance > 0.0)) self.sums.total = 0.0;
    return self;
}

/// See TexturedPolygon::unshadowed() of C++.
vec3 textured_cells_unshadowed(const TexturedCells self) {
    return self.sums.total > 0.0 ? (1.0 / kNusseltPi) * self.unshadowed : vec3(0.0);
}

TextureRectangle textured_cell_rectangle(const CellChoice self) {
    return TextureRectangle(vec2(lattice_position(self.at.x), lattice_position(self.at.y)),
                            vec2(lattice_position(self.at.x + 1), lattice_position(self.at.y + 1)));
}

/// Whether the texture varies less in a cell than the cosine, in terms of squared coefficients of variation.
bool textured_view_is_smooth(const TexturedView self, const CellChoice cell) {
    float variation = textured_light_variation(self.light, cell_choice_index(cell));
    TextureRectangle r = textured_cell_rectangle(cell);
    vec2 middle = 0.5 * (r.low + r.high);
    vec3 centre = texture_plane_point_at(self.image, middle);
    if (!(variation * dot(centre, centre) * float(kNusseltCells * kNusseltCells) > self.image_area)) return true;

    vec2 left = vec2(relative_cosine(self.image, r.low.x, r.low.y), relative_cosine(self.image, r.low.x, r.high.y));
    vec2 right = vec2(relative_cosine(self.image, r.high.x, r.low.y), relative_cosine(self.image, r.high.x, r.high.y));
    vec4 corners = vec4(left, right);
    float at_centre = relative_cosine(self.image, middle.x, middle.y);
    float mean = 2.0 / 3.0 * at_centre + 1.0 / 12.0 * ((corners.x + corners.y) + (corners.z + corners.w));
    float inverse = mean > 0.0 ? 1.0 / mean : 0.0;
    vec4 deviation = corners * inverse - vec4(1.0);
    float of_centre = at_centre * inverse - 1.0;
    float spread = 1.0 / 12.0 * dot(deviation, deviation) + 8.0 / 12.0 * of_centre * of_centre;
    return !(variation > spread) || !(mean > 0.0);
}

/// Where samples of a cell are: anywhere in a smooth cell, in one texel of a busy one.
struct TexturedSpot {
    CellChoice cell;
    bool is_smooth;
    TexelChoice texel;          ///< busy cells only
    TextureRectangle rectangle; ///< the cell or the texel
    bool is_whole;              ///< whether all of the rectangle is inside of the outline
    TexturePart part;           ///< the part of the rectangle inside of the outline
};

/// \param texel any, if the cell is smooth.
TexturedSpot textured_view_spot(const TexturedView self, const CellChoice cell, bool is_smooth,
                                const TexelChoice texel) {
    TexturedSpot spot;
    spot.cell = cell;
    spot.is_smooth = is_smooth;
    spot.texel = texel;
    spot.rectangle = textured_cell_rectangle(cell);
    if (!is_smooth) {
        vec2 size = 1.0 / vec2(pyramid_size_of(textured_light_shape(self.light), 0));
        spot.rectangle = TextureRectangle(vec2(texel.at) * size, vec2(texel.at + 1) * size);
    }
    spot.is_whole = textured_light_cover(self.light, cell_choice_index(cell)) == 1.0 ||
                    textured_light_contains(self.light, spot.rectangle);
    spot.part = texture_part_of(spot.rectangle);
    if (!spot.is_whole) spot.part = textured_light_part_in(self.light, spot.rectangle);
    return spot;
}

/// The spot that random numbers choose, with the random numbers that are left.
/// \param cell with the random numbers inside of it.
TexturedSpot textured_view_spot_of(const TexturedView self, const CellChoice cell) {
    bool is_smooth = textured_view_is_smooth(self, cell);
    TexelChoice texel = TexelChoice(ivec2(0), 0.0, vec2(0.0));
    if (!is_smooth) texel = choose_texel(self.light, self.image, cell.at, cell.u);
    return textured_view_spot(self, cell, is_smooth, texel);
}
TexturedSpot textured_cells_spot_of(const TexturedCells self, vec2 u) {
    return textured_view_spot_of(self.view, cell_sums_choose(self.sums, u));
}

/// The spot where a point is.
/// \param cell that has it.
/// \param at   texture coordinates.
TexturedSpot textured_view_spot_at(const TexturedView self, const CellChoice cell, vec2 at) {
    ivec2 size = pyramid_size_of(textured_light_shape(self.light), 0);
    ivec2 texel = clamp(ivec2(at * vec2(size)), ivec2(0), size - 1);
    return textured_view_spot(self, cell, textured_view_is_smooth(self, cell), TexelChoice(texel, 1.0, vec2(0.0)));
}
TexturedSpot textured_cells_spot_at(const TexturedCells self, vec2 at) {
    return textured_view_spot_at(self.view, cell_sums_at(self.sums, at), at);
}

vec2 clamped(vec2 at, const TextureRectangle r) {
    const float below = 0.999999940395355224609375;
    return vec2(nusselt_max(nusselt_min(at.x, below * r.high.x), r.low.x),
                nusselt_max(nusselt_min(at.y, below * r.high.y), r.low.y));
}

/// The sample of the technique in a smooth cell.
TexturedSample textured_view_smooth_sample(const TexturedView self, const TexturedSpot spot, const LightSample s) {
    vec2 at = clamped(texture_plane_coordinates(self.plane, s.p), spot.rectangle);
    // The same point up to rounding, but in the plane in any case.
    return TexturedSample(s.wi, spot.cell.probability * s.pdf,
                          self.inverse_scale * texture_plane_point_at(self.plane, at), at);
}

/// The share of the texture that a texel has.
float textured_spot_size(const TexturedSpot self) {
    vec2 extent = self.rectangle.high - self.rectangle.low;
    return self.is_whole ? extent.x * extent.y : texture_part_area(self.part);
}

/// The density of a direction to a point that is uniform in a part of the texture.
/// \param size share of the texture.
float textured_view_texel_density(const TexturedView self, float probability, float size, vec3 wi, vec3 p) {
    if (!(probability > 0.0) || !(size > 0.0) || !(wi.z > self.lowest)) return 0.0;
    float distance = dot(wi, p);
    float projected = size / probability * (self.area * self.distance / nusselt_max(distance, kNusseltTiny));
    return area_density(distance, projected);
}

/// The sample of a texel in a busy cell.
TexturedSample textured_view_busy_sample(const TexturedView self, const TexturedSpot spot) {
    vec2 at = spot.rectangle.low + spot.texel.u * (spot.rectangle.high - spot.rectangle.low);
    if (!spot.is_whole) at = texture_part_sample(spot.part, spot.texel.u);
    at = clamped(at, spot.rectangle);
    vec3 p = texture_plane_point_at(self.plane, at);
    vec3 wi = nusselt_normalize(p);
    float density = textured_view_texel_density(self, spot.cell.probability * spot.texel.probability,
                                                textured_spot_size(spot), wi, p);
    return TexturedSample(wi, density, self.inverse_scale * p, at);
}

/// The density of a point in a busy cell.
/// \param wi its direction.
/// \param at its texture coordinates.
float textured_view_busy_density(const TexturedView self, const TexturedSpot spot, vec3 wi, vec2 at) {
    float probability = ascend_from_texel(self.light, self.image, spot.texel).probability;
    return textured_view_texel_density(self, spot.cell.probability * probability, textured_spot_size(spot), wi,
                                       texture_plane_point_at(self.plane, at));
}

/// The random numbers inside of a busy cell for a point.
vec2 textured_view_busy_invert(const TexturedView self, const TexturedSpot spot, vec2 at) {
    vec2 inside = (at - spot.rectangle.low) / (spot.rectangle.high - spot.rectangle.low);
    TexelChoice texel = spot.texel;
    texel.u = vec2(below_one(inside.x), below_one(inside.y));
    if (!spot.is_whole) texel.u = texture_part_invert(spot.part, at);
    return ascend_from_texel(self.light, self.image, texel).u;
}

/// Texture coordinates of the point in a direction.
vec2 textured_view_hit(const TexturedView self, vec3 wi) {
    float farthest = nusselt_max(nusselt_length(self.plane.corner),
                                 nusselt_length(texture_plane_point_at(self.plane, vec2(1.0, 0.0))));
    farthest = nusselt_max(farthest, nusselt_length(texture_plane_point_at(self.plane, vec2(1.0))));
    farthest = nusselt_max(farthest, nusselt_length(texture_plane_point_at(self.plane, vec2(0.0, 1.0))));
    float side = copysign(1.0, dot(self.plane.normal, wi));
    LightPlane plane = LightPlane(self.plane.normal, side * self.distance, farthest);
    return texture_plane_coordinates(self.plane, light_plane_distance_along(plane, wi) * wi);
}

#endif
