#ifndef NUSSELT_EMISSION_CELL_DESCENT_GLSL
#define NUSSELT_EMISSION_CELL_DESCENT_GLSL
// Follows include/nusselt/emission/cell_descent.h @ 79b25b50acfb
/// How samples descend from a cell of the lattice to a texel: in proportion to what texels emit times the cosine over
/// the squared distance. Twin of DescentByProduct in include/nusselt/emission/cell_descent.h.

#include "../emission/texel_choice.glsl"
#include "../emission/textured_light.glsl"

/// The integrand of projected solid angles over a texture, up to a factor: zero below the horizon.
float relative_cosine(const TexturePlane plane, float x, float y) {
    vec3 p = nusselt_fma(x, plane.side_x, nusselt_fma(y, plane.side_y, plane.corner));
    float squared = nusselt_max(dot(p, p), kNusseltTiny);
    return (nusselt_max(p.z, 0.0) / squared) / squared;
}

/// The weights of the parts of element (i, j) of a grid, in the order (0, 0), (1, 0), (0, 1), (1, 1). Those that do not
/// exist weigh nothing.
/// \param parts pyramid_parts_of()
vec4 lit_parts(uint light, const PyramidShape shape, const TexturePlane plane, int level, ivec2 at, ivec2 parts) {
    uint below = light + textured_light_word(light + kNusseltGrids + uint(level - 1));
    uint count = uint(parts.x * parts.y);
    uint first = below + count * uint(at.y * pyramid_size_of(shape, level).x + at.x);
    uint second = first + (count - uint(parts.x));
    uint right = uint(parts.x - 1);
    vec4 weight = vec4(textured_light_float(first), textured_light_float(first + right), textured_light_float(second),
                       textured_light_float(second + right));
    if (parts.x == 1) weight.yw = vec2(0.0);
    if (parts.y == 1) weight.zw = vec2(0.0);

    // The rule for the mean of a quadratic function: centres count 2/3, corners 1/12 each. Corners are at multiples of
    // two steps.
    vec2 size = 1.0 / vec2(pyramid_size_of(shape, level));
    vec2 low = vec2(at) * size;
    vec2 width = size / vec2(2 * parts);
    vec3 x = nusselt_fma(width.x, vec3(0.0, 2.0, 4.0), vec3(low.x));
    vec3 y = nusselt_fma(width.y, vec3(0.0, 2.0, 4.0), vec3(low.y));
    vec2 middle_x = vec2(low.x + width.x, low.x + 3.0 * width.x);
    vec2 middle_y = vec2(low.y + width.y, low.y + 3.0 * width.y);
    vec3 bottom = vec3(relative_cosine(plane, x.x, y.x), relative_cosine(plane, x.y, y.x),
                       relative_cosine(plane, x.z, y.x));
    vec3 middle = vec3(relative_cosine(plane, x.x, y.y), relative_cosine(plane, x.y, y.y),
                       relative_cosine(plane, x.z, y.y));
    vec3 top = vec3(relative_cosine(plane, x.x, y.z), relative_cosine(plane, x.y, y.z),
                    relative_cosine(plane, x.z, y.z));
    vec4 centres = vec4(relative_cosine(plane, middle_x.x, middle_y.x), relative_cosine(plane, middle_x.y, middle_y.x),
                        relative_cosine(plane, middle_x.x, middle_y.y), relative_cosine(plane, middle_x.y, middle_y.y));
    vec4 corners = vec4((bottom.xy + bottom.yz) + (middle.xy + middle.yz), (middle.xy + middle.yz) + (top.xy + top.yz));
    return weight * (2.0 / 3.0 * centres + 1.0 / 12.0 * corners);
}

/// Descends from a cell to a texel. With one random number per direction, the order of texels in each direction stays.
TexelChoice choose_texel(uint light, const TexturePlane plane, ivec2 cell, vec2 u) {
    PyramidShape shape = textured_light_shape(light);
    TexelChoice choice = TexelChoice(cell, 1.0, u);
    for (int level = shape.levels - 1; level > 0; --level) {
        ivec2 parts = pyramid_parts_of(shape, level);
        vec4 weight = lit_parts(light, shape, plane, level, choice.at, parts);
        descend_to_part(choice, weight, parts);
    }
    return choice;
}

/// The probability of a texel given its cell, and the random numbers that lead there.
/// \param choice with the texel, and with the random numbers inside of it.
TexelChoice ascend_from_texel(uint light, const TexturePlane plane, TexelChoice choice) {
    PyramidShape shape = textured_light_shape(light);
    choice.probability = 1.0;
    for (int level = 1; level < shape.levels; ++level) {
        ivec2 parts = pyramid_parts_of(shape, level);
        ivec2 part = choice.at & (parts - 1);
        choice.at = choice.at >> (parts - 1);
        vec4 weight = lit_parts(light, shape, plane, level, choice.at, parts);
        ascend_from_part(choice, part, weight);
    }
    return choice;
}

#endif
