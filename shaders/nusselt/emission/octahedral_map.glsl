#ifndef NUSSELT_EMISSION_OCTAHEDRAL_MAP_GLSL
#define NUSSELT_EMISSION_OCTAHEDRAL_MAP_GLSL
// Follows include/nusselt/emission/octahedral_map.h @ 525582937c6f
/// The square whose points are all directions, each texel with the same solid angle. Twin of
/// include/nusselt/emission/octahedral_map.h.
///
/// P. Clarberg 2008, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, Journal of Graphics Tools 13(3),
/// doi:10.1080/2151237X.2008.10129263.

#include "../core/trig.glsl"

/// The unit direction at a point of the square. The map keeps areas: the square has the solid angle 4 pi.
/// \param at in [0, 1]^2.
vec3 octahedral_direction(vec2 at) {
    // Distances from the middle of the square and from its edges, in half sides. Both are exact.
    vec2 x = 2.0 * at - 1.0;
    vec2 edge = vec2(2.0 * nusselt_min(at.x, 1.0 - at.x), 2.0 * nusselt_min(at.y, 1.0 - at.y));
    // The triangles around the centre are the upper hemisphere. Those in the corners are mirror images of it.
    bool upper = edge.x + edge.y >= 1.0;
    float a = upper ? abs(x.x) : edge.y;
    float b = upper ? abs(x.y) : edge.x;
    float r = nusselt_min(a + b, 1.0);
    SinCos azimuth = sincos_quarter_turn((0.5 * kNusseltPi) * nusselt_min(b / (r > 0.0 ? r : 1.0), 1.0));
    float across = r * sqrt(2.0 - r * r);
    float height = (1.0 - r) * (1.0 + r);
    return vec3(copysign(across * azimuth.cosine, x.x), copysign(across * azimuth.sine, x.y),
                upper ? height : -height);
}

/// One coordinate of a point of the square.
float octahedral_coordinate(bool lower, float component, float from_middle, float from_edge) {
    float half_side = 0.5 * (lower ? from_edge : from_middle);
    float low = lower ? half_side : 0.5 - half_side;
    float high = lower ? 1.0 - half_side : 0.5 + half_side;
    return below_one(component < 0.0 ? low : high);
}

/// The point of the square for a direction, in [0, 1)^2.
/// \param w unit.
vec2 octahedral_coordinates(vec3 w) {
    // r^2 = 1 - |z| without cancellation.
    float across = sqrt(w.x * w.x + w.y * w.y);
    float r = nusselt_min(across / sqrt(1.0 + abs(w.z)), 1.0);
    float b = nusselt_min(r * ((2.0 / kNusseltPi) * atan2_positive(abs(w.y), abs(w.x))), r);
    float a = r - b;
    bool lower = w.z < 0.0;
    return vec2(octahedral_coordinate(lower, w.x, a, b), octahedral_coordinate(lower, w.y, b, a));
}

/// The texel at an index that may lie one texel beyond the square: each edge meets its own mirror image.
/// \param at column and row from -1 to size.
ivec2 wrap_octahedral(ivec2 at, int size) {
    if (at.x < 0 || at.x >= size) at = ivec2(at.x < 0 ? 0 : size - 1, size - 1 - at.y);
    if (at.y < 0 || at.y >= size) at = ivec2(size - 1 - at.x, at.y < 0 ? 0 : size - 1);
    return at;
}

#endif
