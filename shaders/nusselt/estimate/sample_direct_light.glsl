#ifndef NUSSELT_ESTIMATE_SAMPLE_DIRECT_LIGHT_GLSL
#define NUSSELT_ESTIMATE_SAMPLE_DIRECT_LIGHT_GLSL
// Follows include/nusselt/estimate/direct_light.h @ 4b9d3b0dafd3
/// Direct light in one call, in world space, with the projected solid angle and linearly transformed cosines. Twin of
/// the end of include/nusselt/estimate/direct_light.h.

#include "../estimate/direct_light.glsl"
#include "../estimate/surface.glsl"
#include "../sampling/line_ltc.glsl"
#include "../sampling/polygon_ltc.glsl"

/// A point of a surface in world space, with the Frostbite BRDF.
struct SurfacePoint {
    vec3 position;   ///< [m]
    vec3 normal;     ///< unit
    vec3 wo;         ///< unit direction to the eye
    vec3 albedo;     ///< of the diffuse component, in [0, 1]
    vec3 f0;         ///< reflectance of the specular component at normal incidence, in [0, 1]
    float roughness; ///< perceptual, in [0, 1]
};

/// A sample of direct light in world space.
struct WorldLightSample {
    vec3 direction; ///< unit, from the point of the surface to the light
    float distance; ///< to the light [m]
    vec3 shadowed;  ///< see DirectLightSample
    vec3 constant;  ///< see DirectLightSample
};

/// Two samples, one for each component.
struct WorldLightSamples {
    WorldLightSample of[2];
};

/// The surface that sample_direct_light() sees at a point.
GlossySurface glossy_surface_at(const SurfacePoint point, const SpecularFit fit) {
    return make_glossy_surface(dot(point.normal, point.wo), point.albedo, point.f0, point.roughness, fit);
}

WorldLightSample to_world(const Frame frame, const DirectLightSample s) {
    return WorldLightSample(frame_to_world(frame, s.wi), nusselt_length(s.p), s.shadowed, s.constant);
}

/// Both techniques for a polygon.
struct PolygonDirectLight {
    GlossySurface surface;
    PolygonProjectedSolidAngle diffuse;
    PolygonLtc specular;
    DirectLight estimator;
};

/// \param light in shading space with wo in the xz half-plane [m].
PolygonDirectLight polygon_direct_light_prepare(const ConvexPolygon light, const GlossySurface surface) {
    PolygonDirectLight self;
    self.surface = surface;
    self.diffuse = polygon_projected_solid_angle_prepare(light);
    self.specular = polygon_ltc_prepare(light, surface.lobe);
    float diffuse_integral = (1.0 / kNusseltPi) * polygon_projected_solid_angle_measure(self.diffuse);
    self.estimator = direct_light_prepare(surface.diffuse_albedo, surface.specular_albedo, diffuse_integral,
                                          polygon_ltc_measure(self.specular), 1.0, 1.0);
    return self;
}

LightSample polygon_direct_light_draw(const PolygonDirectLight self, int drawn, vec2 u) {
    if (drawn == 0) return polygon_projected_solid_angle_sample(self.diffuse, u);
    return direct_light_drawn(self.estimator, 1, polygon_ltc_sample(self.specular, u));
}

MisSample polygon_direct_light_densities_at(const PolygonDirectLight self, const LightSample s) {
    return direct_light_densities_at(self.estimator, s, polygon_projected_solid_angle_pdf(self.diffuse, s.wi),
                                     polygon_ltc_pdf(self.specular, s.wi),
                                     frostbite_eval_components(self.surface.brdf, s.wi));
}

/// \param drawn the technique that takes the sample: 0 for the diffuse component, 1 for the specular one.
/// \param u     random in [0, 1)^2.
DirectLightSample polygon_direct_light_sample(const PolygonDirectLight self, int heuristic, float visibility, int drawn,
                                              vec2 u) {
    LightSample s = polygon_direct_light_draw(self, drawn, u);
    return direct_light_combined(s, mis_estimate(heuristic, drawn, visibility, self.estimator.techniques,
                                                 polygon_direct_light_densities_at(self, s)));
}

/// A sample of either technique, chosen at random: an estimate by itself.
/// \param u random in [0, 1)^2.
DirectLightSample polygon_direct_light_sample_one(const PolygonDirectLight self, vec2 u) {
    OneSampleChoice choice = one_sample_choice_prepare(self.estimator.techniques);
    OneSampleDecision decision = one_sample_choice_decide(choice, u.x);
    LightSample s = polygon_direct_light_draw(self, decision.chosen, vec2(decision.u, u.y));
    return direct_light_combined(s, one_sample_choice_estimate(choice, polygon_direct_light_densities_at(self, s)));
}

/// Both techniques for a line.
struct LineDirectLight {
    GlossySurface surface;
    LineProjectedSolidAngle diffuse;
    LineLtc specular;
    DirectLight estimator;
};

/// \param light in shading space with wo in the xz half-plane [m].
LineDirectLight line_direct_light_prepare(const LineSegment light, const GlossySurface surface) {
    LineDirectLight self;
    self.surface = surface;
    self.diffuse = line_projected_solid_angle_prepare(light);
    self.specular = line_ltc_prepare(light, surface.lobe);
    float diffuse_integral = (1.0 / kNusseltPi) * line_projected_solid_angle_measure(self.diffuse);
    self.estimator = direct_light_prepare(surface.diffuse_albedo, surface.specular_albedo, diffuse_integral,
                                          line_ltc_measure(self.specular), 1.0, 1.0);
    return self;
}

LightSample line_direct_light_draw(const LineDirectLight self, int drawn, float u) {
    if (drawn == 0) return line_projected_solid_angle_sample(self.diffuse, u);
    return direct_light_drawn(self.estimator, 1, line_ltc_sample(self.specular, u));
}

MisSample line_direct_light_densities_at(const LineDirectLight self, const LightSample s) {
    return direct_light_densities_at(self.estimator, s, line_projected_solid_angle_pdf(self.diffuse, s.wi),
                                     line_ltc_pdf(self.specular, s.wi),
                                     frostbite_eval_components(self.surface.brdf, s.wi));
}

/// \param drawn the technique that takes the sample: 0 for the diffuse component, 1 for the specular one.
/// \param u     random in [0, 1).
DirectLightSample line_direct_light_sample(const LineDirectLight self, int heuristic, float visibility, int drawn,
                                           float u) {
    LightSample s = line_direct_light_draw(self, drawn, u);
    return direct_light_combined(s, mis_estimate(heuristic, drawn, visibility, self.estimator.techniques,
                                                 line_direct_light_densities_at(self, s)));
}

/// A sample of either technique, chosen at random: an estimate by itself.
/// \param u random in [0, 1).
DirectLightSample line_direct_light_sample_one(const LineDirectLight self, float u) {
    OneSampleChoice choice = one_sample_choice_prepare(self.estimator.techniques);
    OneSampleDecision decision = one_sample_choice_decide(choice, u);
    LightSample s = line_direct_light_draw(self, decision.chosen, decision.u);
    return direct_light_combined(s, one_sample_choice_estimate(choice, line_direct_light_densities_at(self, s)));
}

/// Everything in one call: an unbiased estimate of the light that a point of a surface reflects, from two samples. It
/// is the sum over both of radiance (visibility shadowed + constant).
/// \param light      in world space.
/// \param fit        of the specular Frostbite BRDF, for the roughness, f0 and dot(normal, wo) of the point: fit_of().
/// \param heuristic  kNusseltMis* of mis_estimate(), such as kNusseltMisClampedOptimal.
/// \param visibility of the heuristic, such as 0.5.
/// \param u0, u1     independent points of [0, 1)^2 for both samples.
WorldLightSamples sample_direct_light(const SurfacePoint point, const ConvexPolygon light, const SpecularFit fit,
                                      int heuristic,
                                      float visibility, vec2 u0, vec2 u1) {
    Frame frame = shading_frame(point.normal, point.wo);
    PolygonDirectLight techniques = polygon_direct_light_prepare(to_shading_space(light, point.position, frame),
                                                                 glossy_surface_at(point, fit));
    return WorldLightSamples(WorldLightSample[2](
        to_world(frame, polygon_direct_light_sample(techniques, heuristic, visibility, 0, u0)),
        to_world(frame, polygon_direct_light_sample(techniques, heuristic, visibility, 1, u1))));
}

/// The same for a line; its emission is radiance times radius.
/// \param u0, u1 independent numbers in [0, 1).
WorldLightSamples sample_direct_light(const SurfacePoint point, const LineSegment light, const SpecularFit fit,
                                      int heuristic,
                                      float visibility, float u0, float u1) {
    Frame frame = shading_frame(point.normal, point.wo);
    LineDirectLight techniques =
        line_direct_light_prepare(to_shading_space(light, point.position, frame), glossy_surface_at(point, fit));
    return WorldLightSamples(
        WorldLightSample[2](to_world(frame, line_direct_light_sample(techniques, heuristic, visibility, 0, u0)),
                            to_world(frame, line_direct_light_sample(techniques, heuristic, visibility, 1, u1))));
}

#endif
