#ifndef NUSSELT_LTC_LTC_GLSL
#define NUSSELT_LTC_LTC_GLSL
// Follows include/nusselt/ltc/ltc.h @ e48bc0cdcdda
/// Linearly transformed cosines (LTCs): the lobe of a glossy surface as the image of a clamped cosine.
///
/// E. Heitz, J. Dupuy, S. Hill, D. Neubelt 2016, Real-Time Polygonal-Light Shading with Linearly Transformed Cosines,
/// doi:10.1145/2897824.2925895. Twin of include/nusselt/ltc/ltc.h.
///
/// Two spaces: shading space, where the normal is +z and wo lies in the xz half-plane with x >= 0 (shading_frame()),
/// and cosine space, where the density of the lobe is that of a clamped cosine.

#include "../core/frame.glsl"
#include "../core/trig.glsl"
#include "../ltc/coefficients.glsl"

/// The frame of a surface in which LTCs are meant: normal +z, wo in the xz half-plane with x >= 0. Where wo is (anti-)
/// parallel to the normal up to rounding, any tangent will do: the lobe is the same around it.
/// \param normal unit, in world space.
/// \param wo     unit direction to the eye, in world space.
Frame shading_frame(vec3 normal, vec3 wo) {
    // The components of this cross product are accurate relative to themselves: it stays perpendicular to the normal
    // until nothing is left of it, unlike wo minus its part along the normal.
    vec3 across = nusselt_cross(normal, wo);
    vec3 b = frame_from_normal(normal).b;
    if (largest_component(across) > kNusseltEpsilon) b = nusselt_normalize(across);
    return Frame(nusselt_cross(b, normal), b, normal);
}

/// A lobe: the density of directions in shading space that a linear map takes to the clamped cosine.
struct Ltc {
    float m00, m02, m11, m20, m22; ///< cosine_from_shading, scaled by a power of two: the largest is of order one
    float minor;                   ///< m00 m22 - m02 m20; what to_shading and normal_to_cosine are scaled by, > 0
    float lateral;                 ///< minor / m11
};

/// \param c with a positive determinant and m11 > 0, as those of a table; the albedo is not used.
Ltc ltc_prepare(const LtcCoefficients c) {
    float extent = nusselt_max(nusselt_max(abs(c.m00), abs(c.m02)), nusselt_max(abs(c.m20), abs(c.m22)));
    float scale = reciprocal_power_of_two(nusselt_max(extent, abs(c.m11)));
    Ltc self;
    self.m00 = scale * c.m00;
    self.m02 = scale * c.m02;
    self.m11 = scale * c.m11;
    self.m20 = scale * c.m20;
    self.m22 = scale * c.m22;
    self.minor = difference_of_products(self.m00, self.m22, self.m02, self.m20);
    self.lateral = self.minor / self.m11;
    return self;
}

/// A vector of shading space in cosine space, scaled by a number of the order of one that depends on the lobe only.
/// Narrow lobes make both terms of a component large and their sum small: it is accurate relative to itself.
vec3 ltc_to_cosine(const Ltc self, vec3 v) {
    return vec3(difference_of_products(self.m00, v.x, -self.m02, v.z), self.m11 * v.y,
                difference_of_products(self.m20, v.x, -self.m22, v.z));
}

/// A vector of cosine space in shading space: that of ltc_to_cosine(self, v) is self.minor * v.
vec3 ltc_to_shading(const Ltc self, vec3 v) {
    return vec3(difference_of_products(self.m22, v.x, self.m02, v.z), self.lateral * v.y,
                difference_of_products(self.m00, v.z, self.m20, v.x));
}

/// The normal of a plane of shading space in cosine space, of any length: its dot product with ltc_to_cosine(self, v)
/// is self.minor * dot(n, v).
vec3 ltc_normal_to_cosine(const Ltc self, vec3 n) {
    return vec3(difference_of_products(self.m22, n.x, self.m20, n.z), self.lateral * n.y,
                difference_of_products(self.m00, n.z, self.m02, n.x));
}

/// Density of the lobe with respect to solid angle [1/sr]: it integrates to 1 over the sphere. 0 beyond the horizon of
/// cosine space, which is not that of the surface: the lobe also has directions below the surface.
/// \param wi unit direction in shading space.
float ltc_density(const Ltc self, vec3 wi) {
    vec3 o = ltc_to_cosine(self, wi);
    float squared = dot(o, o);
    if (!(squared > 0.0)) return 0.0;
    float inverse = 1.0 / squared;
    // Each factor is in the range of float, also where the lobe is as narrow as 1e-5.
    return (1.0 / kNusseltPi) * ((self.minor * inverse) * (self.m11 * (nusselt_max(o.z, 0.0) * inverse)));
}

#endif
