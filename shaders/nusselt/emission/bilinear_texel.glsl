#ifndef NUSSELT_EMISSION_BILINEAR_TEXEL_GLSL
#define NUSSELT_EMISSION_BILINEAR_TEXEL_GLSL
// Follows include/nusselt/emission/bilinear_texel.h @ 422588cf4078
/// Exact sampling of bilinear interpolation in one texel. Twin of include/nusselt/emission/bilinear_texel.h.

#include "../emission/texel_choice.glsl"

/// A density on [0, 1] that is linear from the lower edge of a texel to its centre, and from there to the upper edge:
/// the interpolation between the texel and its two neighbours.
struct TexelTent {
    float before, middle, after; ///< at the centres of texels, not negative; not normalised
};

/// \param x in [0, 1].
float texel_tent_value(const TexelTent self, float x) {
    float off_middle = abs(x - 0.5);
    return self.middle + off_middle * ((x < 0.5 ? self.before : self.after) - self.middle);
}

/// Values at both ends of a half, of order one.
vec2 texel_tent_ends_of(const TexelTent self, bool upper) {
    float edge = 0.5 * ((upper ? self.after : self.before) + self.middle);
    float scale = reciprocal_power_of_two(nusselt_max(edge, self.middle));
    return scale * (upper ? vec2(self.middle, edge) : vec2(edge, self.middle));
}

/// \param u in [0, 1).
float texel_tent_sample(const TexelTent self, float u) {
    bool upper = choose_of_two(self.before + 3.0 * self.middle, 3.0 * self.middle + self.after, u);
    vec2 ends = texel_tent_ends_of(self, upper);
    float root = sqrt(ends.x * ends.x + u * (ends.y * ends.y - ends.x * ends.x));
    float sum = ends.x + root;
    float share = sum > 0.0 ? u * (ends.x + ends.y) / sum : u;
    return 0.5 * ((upper ? 1.0 : 0.0) + nusselt_min(share, 1.0));
}

/// What texel_tent_sample() undoes.
float texel_tent_invert(const TexelTent self, float x) {
    bool upper = !(x < 0.5);
    vec2 ends = texel_tent_ends_of(self, upper);
    float share = 2.0 * x - (upper ? 1.0 : 0.0);
    float sum = ends.x + ends.y;
    float u = sum > 0.0 ? share * ((2.0 - share) * ends.x + share * ends.y) / sum : share;
    return unite_of_two(self.before + 3.0 * self.middle, 3.0 * self.middle + self.after, upper, u);
}

/// A texel and its eight neighbours.
struct BilinearTexel {
    vec3 below, middle, above; ///< rows; the texel is in the middle
};

/// The mean over the height of the texel.
TexelTent bilinear_texel_columns(const BilinearTexel self) {
    vec3 mean = 0.125 * (self.below + self.above) + 0.75 * self.middle;
    return TexelTent(mean.x, mean.y, mean.z);
}
/// Along y, where the position along x is known.
TexelTent bilinear_texel_row_at(const BilinearTexel self, float x) {
    return TexelTent(texel_tent_value(TexelTent(self.below.x, self.below.y, self.below.z), x),
                     texel_tent_value(TexelTent(self.middle.x, self.middle.y, self.middle.z), x),
                     texel_tent_value(TexelTent(self.above.x, self.above.y, self.above.z), x));
}

// Positions are relative to the texel, in [0, 1]^2.
float bilinear_texel_at(const BilinearTexel self, vec2 x) {
    return texel_tent_value(bilinear_texel_row_at(self, x.x), x.y);
}
vec2 bilinear_texel_sample(const BilinearTexel self, vec2 u) {
    float x = texel_tent_sample(bilinear_texel_columns(self), u.x);
    return vec2(x, texel_tent_sample(bilinear_texel_row_at(self, x), u.y));
}
vec2 bilinear_texel_invert(const BilinearTexel self, vec2 x) {
    return vec2(texel_tent_invert(bilinear_texel_columns(self), x.x),
                texel_tent_invert(bilinear_texel_row_at(self, x.x), x.y));
}

#endif
