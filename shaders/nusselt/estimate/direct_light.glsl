#ifndef NUSSELT_ESTIMATE_DIRECT_LIGHT_GLSL
#define NUSSELT_ESTIMATE_DIRECT_LIGHT_GLSL
// Follows include/nusselt/estimate/direct_light.h @ 4b9d3b0dafd3
/// The light that a surface with a diffuse and a specular component reflects from one light, estimated without bias
/// from a few samples. Twin of include/nusselt/estimate/direct_light.h, where the sources stand.
///
/// GLSL has no templates: who calls this prepares two techniques for the light, takes a sample of one of them, and
/// returns the densities of both. With the projected solid angle and linearly transformed cosines, for a polygon:
///
///     PolygonProjectedSolidAngle diffuse = polygon_projected_solid_angle_prepare(light);
///     PolygonLtc specular = polygon_ltc_prepare(light, surface.lobe);
///     float diffuse_integral = (1.0 / kNusseltPi) * polygon_projected_solid_angle_measure(diffuse);
///     DirectLight estimator = direct_light_prepare(surface.diffuse_albedo, surface.specular_albedo, diffuse_integral,
///                                                  polygon_ltc_measure(specular), 1.0, 1.0);
///     LightSample s = direct_light_drawn(estimator, 1, polygon_ltc_sample(specular, u));
///     MisSample at = direct_light_densities_at(estimator, s, polygon_projected_solid_angle_pdf(diffuse, s.wi),
///                                              polygon_ltc_pdf(specular, s.wi),
///                                              frostbite_eval_components(surface.brdf, s.wi));
///     DirectLightSample result = direct_light_combined(s, mis_estimate(heuristic, 1, 0.5, estimator.techniques, at));
///
/// The integral of what a polygon_brdf samples is unknown: pass 0, and use the balance heuristic.

#include "../core/light_sample.glsl"
#include "../estimate/mis.glsl"
#include "../estimate/surface.glsl"

/// A sample of direct light. With V = 1 if the way to the light is free, else 0, and the radiance L of the light [W/(sr
/// m^2)] (radiance times radius [W/(sr m)] for linear lights), it adds L (V shadowed + constant) to the reflected
/// radiance.
struct DirectLightSample {
    vec3 wi;       ///< unit direction to the light, in shading space
    vec3 p;        ///< the point on the light [m]
    vec3 shadowed; ///< zero where no shadow ray is needed
    vec3 constant; ///< zero but for the optimal heuristic
};

/// One light at one surface point.
///
/// Unbiased for all heuristics, unless a technique is biased itself: technique 0, for the diffuse component, covers all
/// of the light above the surface and takes over where the lobe is zero; samples below the surface count, with a BRDF
/// of zero.
struct DirectLight {
    bool glossy; ///< if not, technique 1 is left out
    MisTechniques techniques;
};

/// \param diffuse_albedo, specular_albedo     of the surface, see GlossySurface.
/// \param diffuse_integral, specular_integral of the normalised components over the light, as both techniques know
///                          them.
/// \param diffuse_samples, specular_samples   how many samples of each there will be, > 0.
DirectLight direct_light_prepare(vec3 diffuse_albedo, vec3 specular_albedo, float diffuse_integral,
                                 float specular_integral, float diffuse_samples, float specular_samples) {
    vec3 clamped = nusselt_max(diffuse_albedo, vec3(kNusseltSmallestDiffuseAlbedo));
    return DirectLight(is_glossy(specular_albedo),
                       MisTechniques(float[2](diffuse_samples, specular_samples),
                                     vec3[2](diffuse_integral * clamped, specular_integral * specular_albedo)));
}

/// A sample of technique `drawn`, 0 or 1, as it counts: none of technique 1 where the surface is not glossy.
LightSample direct_light_drawn(const DirectLight self, int drawn, LightSample s) {
    if (drawn == 1 && !self.glossy) s.pdf = 0.0;
    return s;
}

/// Densities and components at a sample.
/// \param s                         by direct_light_drawn().
/// \param diffuse_pdf, specular_pdf densities of both techniques in direction s.wi.
/// \param brdf                      in direction s.wi.
MisSample direct_light_densities_at(const DirectLight self, const LightSample s, float diffuse_pdf, float specular_pdf,
                                    const BrdfComponents brdf) {
    // NaN, which no technique should return, counts as drawn, so that it is noticed.
    bool drawn = s.pdf != 0.0;
    bool above = drawn && s.wi.z > 0.0;
    // Densities are those that samples really have, below the surface too: the optimal heuristic counts on it.
    return MisSample(float[2](drawn ? diffuse_pdf : 0.0, drawn && self.glossy ? specular_pdf : 0.0),
                     vec3[2](above ? s.wi.z * brdf.diffuse : vec3(0.0), above ? s.wi.z * brdf.specular : vec3(0.0)));
}

DirectLightSample direct_light_combined(const LightSample s, const MisEstimate estimate) {
    // At a line that almost meets the point this overflows, and infinity times no visibility is NaN.
    vec3 f = estimate.shadowed;
    vec3 limited = vec3(f.x > kNusseltLargest ? 0.0 : f.x, f.y > kNusseltLargest ? 0.0 : f.y,
                        f.z > kNusseltLargest ? 0.0 : f.z);
    return DirectLightSample(s.wi, s.p, limited, estimate.constant);
}

#endif
