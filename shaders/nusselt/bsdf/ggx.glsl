#ifndef NUSSELT_BSDF_GGX_GLSL
#define NUSSELT_BSDF_GGX_GLSL
// Follows include/nusselt/bsdf/ggx.h @ aa133c5bd822
/// Functions that BRDFs and samplers with GGX normals share. Twin of include/nusselt/bsdf/ggx.h.

#include "../core/trig.glsl"
#include "../core/vec.glsl"

/// Smallest GGX alpha.
const float kNusseltSmallestGgxAlpha = 1e-4;

/// The alpha of GGX: the square of the roughness, but at least kNusseltSmallestGgxAlpha.
/// \param roughness perceptual ("linear") roughness, clamped to [0, 1]; NaN counts as 0.
float ggx_alpha(float roughness) {
    float clamped = nusselt_min(nusselt_max(roughness, 0.0), 1.0);
    return nusselt_max(clamped * clamped, kNusseltSmallestGgxAlpha);
}

/// |h|^2 / (h.x^2 + h.y^2 + alpha^2 h.z^2), from which the density of normals follows. The textbook's
/// (n.h)^2 (alpha^2 - 1) + 1 cancels in narrow lobes; this is a quotient of sums of positive terms.
/// \param h half vector in shading space of any length but 0, such as wo + wi.
float ggx_ratio(vec3 h, float alpha2) {
    // The scaled vector has a length near one even if the directions almost oppose each other.
    vec3 scaled = reciprocal_power_of_two(largest_component(h)) * h;
    float plane2 = dot(scaled.xy, scaled.xy);
    float height2 = scaled.z * scaled.z;
    return (plane2 + height2) / (plane2 + alpha2 * height2);
}

/// Density D of normals: its integral times the cosine is 1 [1/sr].
/// \param ratio ggx_ratio() of the half vector.
float ggx_distribution(float ratio, float alpha2) { return alpha2 * ratio * ratio * (1.0 / kNusseltPi); }

#endif
