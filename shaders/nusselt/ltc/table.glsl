#ifndef NUSSELT_LTC_TABLE_GLSL
#define NUSSELT_LTC_TABLE_GLSL
// Follows include/nusselt/ltc/table.h @ e0c2258767c9
// Follows include/nusselt/ltc/table_file.h @ a47ad8074362
/// Tables of linearly transformed cosines and their interpolation, between the fetches that a program makes: from a 3D
/// texture or from a buffer. Twin of include/nusselt/ltc/table.h and table_file.h, where the meaning of entries stands.
///
/// A lookup adds up eight neighbours:
///
///     LtcTableCell cell = ltc_table_cell(roughness, cos_o, f0, textureSize(shapes, 0));
///     LtcTableEntry sum = LtcTableEntry(vec3(0.0), vec3(0.0));
///     for (int corner = 0; corner < 8; ++corner) {
///         ivec3 at = ltc_table_corner(cell, corner);
///         LtcTableEntry entry = ltc_table_entry(texelFetch(shapes, at, 0), texelFetch(albedos, at, 0).x);
///         ltc_table_add(sum, ltc_table_weight(cell, corner), entry);
///     }
///     LtcCoefficients lobe = ltc_table_coefficients(sum);
///
/// Samplers must not do that: the weights of their filters have eight bits, too few for the place of a narrow lobe.

#include "../core/trig.glsl"
#include "../core/vec.glsl"
#include "../ltc/coefficients.glsl"

/// The coordinates of a lookup. Components are f0, inclination and roughness: x, y and z of a 3D texture into which the
/// samples of a table go in their order.
struct LtcTableCell {
    ivec3 low;     ///< the corner with the smallest indices
    vec3 fraction; ///< of the cell, from there, in [0, 1]
};

/// Arguments are clamped, NaN is taken for 0.
/// \param roughness perceptual.
/// \param cos_o     cosine of the inclination of wo.
/// \param samples   how many there are of f0, inclination and roughness, at least 2 each.
LtcTableCell ltc_table_cell(float roughness, float cos_o, float f0, ivec3 samples) {
    float c = nusselt_min(nusselt_max(cos_o, 0.0), 1.0);
    float inclination = atan2_positive(sqrt((1.0 - c) * (1.0 + c)), c) * (2.0 / kNusseltPi);
    vec3 position = nusselt_min(nusselt_max(vec3(f0, inclination, roughness), vec3(0.0)), vec3(1.0));
    vec3 x = position * vec3(samples - 1);
    vec3 low = nusselt_min(floor(x), vec3(samples - 2));
    return LtcTableCell(ivec3(low), x - low);
}

/// The indices of a corner of the cell, 0 to 7. Corners 0, 2, 4 and 6 have the smaller f0.
ivec3 ltc_table_corner(const LtcTableCell cell, int corner) {
    return cell.low + ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
}

/// The weight of a corner.
float ltc_table_weight(const LtcTableCell cell, int corner) {
    vec3 w = vec3(1.0) - cell.fraction;
    return ((corner & 4) == 0 ? w.z : cell.fraction.z) * ((corner & 2) == 0 ? w.y : cell.fraction.y) *
           ((corner & 1) == 0 ? w.x : cell.fraction.x);
}

/// The position of a sample in a buffer.
int ltc_table_index(ivec3 corner, ivec3 samples) {
    return (corner.z * samples.y + corner.y) * samples.x + corner.x;
}

/// The six floats of a sample, or a weighted sum of them.
struct LtcTableEntry {
    vec3 first; ///< m00, m02, 1 / m11
    vec3 last;  ///< -m20, m22, albedo
};

void ltc_table_add(inout LtcTableEntry sum, float weight, const LtcTableEntry entry) {
    sum.first = nusselt_fma(weight, entry.first, sum.first);
    sum.last = nusselt_fma(weight, entry.last, sum.last);
}

/// The lobe at the end of a lookup.
LtcCoefficients ltc_table_coefficients(const LtcTableEntry sum) {
    return LtcCoefficients(sum.first.x, sum.first.y, 1.0 / sum.first.z, -sum.last.x, sum.last.y, sum.last.z);
}

/// Albedo for a coloured f0, of BRDFs that are linear in f0 (as all with Schlick's approximation are).
/// \param of_black, of_white interpolated albedos of the first and of the last sample of f0.
vec3 ltc_table_albedo(float of_black, float of_white, vec3 f0) {
    vec3 f = nusselt_min(nusselt_max(f0, vec3(0.0)), vec3(1.0));
    return f * of_white + (vec3(1.0) - f) * of_black;
}

/// Sine of number / 65535 of a right angle.
float ltc_table_sine(uint number) { return sincos_quarter_turn(float(number) * (kNusseltPi / 131070.0)).sine; }

/// The width or ratio of widths that a number of the file stands for: 2^(27 number / 65535 - 24).
float ltc_table_width(uint number) {
    // Whole octaves and the rest are integers. exp2() may err by 50 roundings.
    uint scaled = 27u * number;
    uint octaves = (scaled + 32767u) / 65535u;
    float rest = float(int(scaled) - int(65535u * octaves)) / 65535.0;
    float p = nusselt_fma(1.54531634e-4, rest, 1.33908633e-3);
    p = nusselt_fma(p, rest, 9.61808302e-3);
    p = nusselt_fma(p, rest, 5.55035695e-2);
    p = nusselt_fma(p, rest, 2.40226507e-1);
    p = nusselt_fma(p, rest, 6.93147182e-1);
    return nusselt_fma(p, rest, 1.0) * uintBitsToFloat((octaves + 103u) << 23);
}

/// A sample of a file (data/ltc-frostbite.bin), by its five numbers of 16 bits.
/// \param shape the first four.
LtcTableEntry ltc_table_entry(uvec4 shape, uint albedo) {
    // Cosines as sines of the complement: they are never negative.
    float width_x = ltc_table_width(shape.z);
    return LtcTableEntry(
        vec3(ltc_table_sine(65535u - shape.x), ltc_table_sine(shape.x), ltc_table_width(shape.w)),
        vec3(width_x * ltc_table_sine(shape.y), width_x * ltc_table_sine(65535u - shape.y), float(albedo) / 65535.0));
}

/// Likewise, from a buffer that holds the file after its header as little-endian words of 32 bits.
/// \param words those from number 5 index / 2 on.
/// \param index ltc_table_index()
LtcTableEntry ltc_table_entry(uvec3 words, int index) {
    if ((index & 1) != 0)
        words = uvec3(words.x >> 16 | words.y << 16, words.y >> 16 | words.z << 16, words.z >> 16);
    return ltc_table_entry(uvec4(words.x & 0xffffu, words.x >> 16, words.y & 0xffffu, words.y >> 16),
                           words.z & 0xffffu);
}

/// A sample of the small table (data/ltc-frostbite-engine.bin), by its six half floats. It has no axis of f0: take the
/// cell with two samples of it and f0 = 0, and only corners 0, 2, 4 and 6.
/// \param shape  the first four.
/// \param albedo scale and bias.
LtcTableEntry ltc_engine_table_entry(vec4 shape, vec2 albedo, float f0) {
    float extent = sqrt(dot(shape.xz, shape.xz));
    return LtcTableEntry(vec3(shape.xz / extent, extent / 1024.0),
                         vec3(-shape.y / extent, shape.w / extent, f0 * albedo.x + albedo.y));
}

#endif
