#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/estimate/sample_direct_light.glsl"
#include "nusselt/sampling/polygon_brdf.glsl"
#include "nusselt/sampling/polygon_solid_angle.glsl"
#include "parity/surface_input.glsl"

// Inputs: as of polygon_direct_light.comp, but the solid angle is sampled, and the BRDF.
void compute(uint i) {
    uint begin = (12u + kSurfaceSize + 7u) * i;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(begin + 3u * j);
    SurfacePoint point = input_surface(begin + 12u);
    uint rest = begin + 12u + kSurfaceSize;
    int heuristic = int(input_at(rest));
    int drawn = int(input_at(rest + 2u));

    Frame frame = shading_frame(point.normal, point.wo);
    ConvexPolygon light = to_shading_space(make_polygon(corners, 4), point.position, frame);
    GlossySurface surface = glossy_surface_at(point, fit_at(point));
    PolygonSolidAngle diffuse = polygon_solid_angle_prepare(light);
    PolygonBrdf specular =
        polygon_brdf_prepare(light, ggx_bounded_visible_normals_prepare(surface.wo, surface.alpha));
    DirectLight estimator =
        direct_light_prepare(surface.diffuse_albedo, surface.specular_albedo,
                             (1.0 / kNusseltPi) * polygon_solid_angle_measure(diffuse), 0.0, 1.0, 1.0);
    LightSample s;
    if (drawn == 0)
        s = polygon_solid_angle_sample(diffuse, vec2(input_at(rest + 3u), input_at(rest + 4u)));
    else
        s = direct_light_drawn(estimator, 1, polygon_brdf_sample(specular, vec2(input_at(rest + 5u), input_at(rest + 6u))));
    MisSample at =
        direct_light_densities_at(estimator, s, polygon_solid_angle_pdf(diffuse, s.wi),
                                  polygon_brdf_pdf(specular, s.wi), frostbite_eval_components(surface.brdf, s.wi));
    MisEstimate estimate = mis_estimate(heuristic, drawn, input_at(rest + 1u), estimator.techniques, at);
    write_sample(to_world(frame, direct_light_combined(s, estimate)));
}
