#ifndef NUSSELT_EMISSION_TEXEL_CHOICE_GLSL
#define NUSSELT_EMISSION_TEXEL_CHOICE_GLSL
// Follows include/nusselt/emission/cell_descent.h @ 79b25b50acfb
/// Single steps of descents from a cell of a lattice to a texel. Twin of descend() and ascend() in
/// include/nusselt/emission/cell_descent.h.

#include "../core/real.glsl"

/// Whether a sampler finds a texel, and how likely it was.
struct TexelChoice {
    ivec2 at;          ///< column and row in the finest grid
    float probability; ///< given the cell; 0 if there is no texel to choose
    vec2 u;            ///< random numbers that are left, in [0, 1)^2
};

/// Whether the second of two weights is chosen, and what is left of u.
bool choose_of_two(float first, float second, inout float u) {
    float target = u * (first + second);
    bool chosen = second > 0.0 && target >= first;
    float rest = target - (chosen ? first : 0.0);
    u = below_one(rest / (chosen ? second : nusselt_max(first, kNusseltSmallestNormal)));
    return chosen;
}

/// What choose_of_two() undoes.
float unite_of_two(float first, float second, bool chosen, float u) {
    float total = first + second;
    return total > 0.0 ? below_one((chosen ? first + u * second : u * first) / total) : 0.0;
}

/// Goes from an element to one of its parts. With one random number per direction, the order of texels is kept in each
/// of them.
/// \param weight of the parts (0, 0), (1, 0), (0, 1), (1, 1). Those that do not exist weigh nothing.
/// \param parts  columns and rows of them, 1 or 2 each.
void descend_to_part(inout TexelChoice choice, vec4 weight, ivec2 parts) {
    vec2 columns = weight.xy + weight.zw;
    bool right = choose_of_two(columns.x, columns.y, choice.u.x);
    vec2 column = right ? weight.yw : weight.xz;
    bool upper = choose_of_two(column.x, column.y, choice.u.y);
    float total = columns.x + columns.y;
    choice.probability = total > 0.0 ? choice.probability * (upper ? column.y : column.x) / total : 0.0;
    choice.at = parts * choice.at + ivec2(right ? 1 : 0, upper ? 1 : 0);
}

/// Undoes descend_to_part() for a choice whose position is that of the element already.
/// \param part   column and row of the part in the element.
/// \param weight see descend_to_part().
void ascend_from_part(inout TexelChoice choice, ivec2 part, vec4 weight) {
    vec2 columns = weight.xy + weight.zw;
    vec2 column = part.x == 1 ? weight.yw : weight.xz;
    choice.u.x = unite_of_two(columns.x, columns.y, part.x == 1, choice.u.x);
    choice.u.y = unite_of_two(column.x, column.y, part.y == 1, choice.u.y);
    float total = columns.x + columns.y;
    choice.probability = total > 0.0 ? choice.probability * (part.y == 1 ? column.y : column.x) / total : 0.0;
}

#endif
