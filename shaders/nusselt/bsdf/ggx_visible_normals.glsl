#ifndef NUSSELT_BSDF_GGX_VISIBLE_NORMALS_GLSL
#define NUSSELT_BSDF_GGX_VISIBLE_NORMALS_GLSL
// Follows include/nusselt/bsdf/ggx_visible_normals.h @ 6b3e37f6e8f0
/// Sampling of the directions in which the visible ones of GGX normals reflect. Twin of
/// include/nusselt/bsdf/ggx_visible_normals.h, where the sources and deviations stand.
///
/// All directions are unit vectors in shading space, pointing away from the surface.
/// Measure: densities of directions with respect to solid angle [1/sr]; their integral over the sphere is 1. Samples
/// may lie below the surface, wi.z <= 0: they count, with a contribution of zero.
/// Edge cases: wo parallel to the normal is fine. wo.z <= 0: nothing is visible, the density is 0, samples are any unit
/// vectors.

#include "../bsdf/ggx.glsl"

/// One surface point seen from one direction.
struct GgxVisibleNormals {
    vec3 wo; ///< the normal where wo.z <= 0
    float alpha;
    float inverse_length; ///< of wo stretched by alpha in x and y
    vec3 stretched;       ///< unit
    float height;         ///< of the cap
    float rim;            ///< height of the rim above the direction opposite to stretched
    float rim_above_pole; ///< height of the rim above (0, 0, -1)
    float factor;         ///< density of directions over that of normals; 0 where wo.z <= 0
};

/// \param lit   whether wo is above the surface; if not, wo is the normal.
/// \param reach which share of the part of the cap below the equator is sampled, in [0, 1].
GgxVisibleNormals ggx_visible_normals_prepare_cap(vec3 wo, bool lit, float alpha, float reach) {
    GgxVisibleNormals self;
    self.wo = wo;
    self.alpha = alpha;
    float plane2 = alpha * alpha * dot(wo.xy, wo.xy);
    float extent = sqrt(plane2 + wo.z * wo.z);
    self.inverse_length = 1.0 / extent;
    self.stretched = self.inverse_length * vec3(alpha * wo.xy, wo.z);
    self.height = 1.0 + reach * self.stretched.z;
    self.rim = (1.0 - reach) * self.stretched.z;
    float above_pole = self.inverse_length * self.inverse_length * plane2 / (1.0 + self.stretched.z);
    self.rim_above_pole = self.rim + above_pole;
    self.factor = lit ? 0.5 / (reach * wo.z + extent) : 0.0;
    return self;
}

float ggx_visible_normals_clamped_alpha(float alpha) {
    return nusselt_min(nusselt_max(alpha, kNusseltSmallestGgxAlpha), 1.0);
}

/// All visible normals, also those that reflect to directions below the surface.
/// \param wo    unit direction to the eye.
/// \param alpha of GGX, such as ggx_alpha(roughness); clamped to [1e-4, 1].
GgxVisibleNormals ggx_visible_normals_prepare(vec3 wo, float alpha) {
    bool lit = wo.z > 0.0;
    return ggx_visible_normals_prepare_cap(lit ? wo : vec3(0.0, 0.0, 1.0), lit,
                                           ggx_visible_normals_clamped_alpha(alpha), 1.0);
}

/// The cap without normals that are sure to reflect to directions below the surface: fewer samples there, at the cost of a
/// square root per surface point. GgxBoundedVisibleNormals in C++.
GgxVisibleNormals ggx_bounded_visible_normals_prepare(vec3 wo, float alpha) {
    bool lit = wo.z > 0.0;
    vec3 upper = lit ? wo : vec3(0.0, 0.0, 1.0);
    float clamped = ggx_visible_normals_clamped_alpha(alpha);
    float alpha2 = clamped * clamped;
    float root = 1.0 + sqrt(dot(upper.xy, upper.xy));
    float root2 = root * root;
    float reach = (1.0 - alpha2) * root2 / (root2 + alpha2 * upper.z * upper.z);
    return ggx_visible_normals_prepare_cap(upper, lit, clamped, reach);
}

/// \param u in [0, 1)^2; x turns around the normal, y leads away from it. Continuous, also from x = 1 to x = 0.
vec3 ggx_visible_normals_sample(const GgxVisibleNormals self, vec2 u) {
    bool first_half = u.x < 0.5;
    SinCos azimuth = sincos_half_turn(2.0 * kNusseltPi * (first_half ? u.x : 1.0 - u.x));
    float sine = first_half ? azimuth.sine : -azimuth.sine;
    // A point of the cap, by its heights above the rim of the cap and above the lower pole of the sphere.
    float above_rim = (1.0 - u.y) * self.height;
    float radius = sqrt(u.y * self.height * (above_rim + self.rim_above_pole));
    vec3 normal = nusselt_normalize(vec3(self.alpha * (radius * azimuth.cosine + self.stretched.x),
                                         self.alpha * (radius * sine + self.stretched.y), above_rim + self.rim));
    return 2.0 * dot(self.wo, normal) * normal - self.wo;
}

/// The height, above the direction opposite to the stretched wo, of the point of the cap that gives a half vector.
float ggx_visible_normals_height_of(const GgxVisibleNormals self, vec3 h, float ratio) {
    return self.alpha * self.alpha * ratio * h.z * self.inverse_length;
}

/// Density of samples [1/sr], at most 1.6e11; 0 where they cannot lead.
/// \param wi unit direction.
float ggx_visible_normals_pdf(const GgxVisibleNormals self, vec3 wi) {
    vec3 h = self.wo + wi;
    float ratio = ggx_ratio(h, self.alpha * self.alpha);
    // All directions above the surface are in the cap, despite rounding.
    bool reached = wi.z > 0.0 || (h.z > 0.0 && ggx_visible_normals_height_of(self, h, ratio) >= self.rim);
    return reached ? ggx_distribution(ratio, self.alpha * self.alpha) * self.factor : 0.0;
}

/// The random numbers for which the sample is wi; anything in [0, 1)^2 where there are none.
/// \param wi unit direction.
vec2 ggx_visible_normals_invert(const GgxVisibleNormals self, vec3 wi) {
    vec3 h = self.wo + wi;
    float ratio = ggx_ratio(h, self.alpha * self.alpha);
    float y = ratio * h.y - self.wo.y;
    float turn = (0.5 / kNusseltPi) * atan2_positive(abs(y), ratio * h.x - self.wo.x);
    float above_rim = ggx_visible_normals_height_of(self, h, ratio) - self.rim;
    return vec2(below_one(y < 0.0 ? 1.0 - turn : turn), below_one(1.0 - above_rim / self.height));
}

#endif
