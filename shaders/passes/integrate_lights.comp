#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
/// Reflected light by integrals of linearly transformed cosines, without samples and without shadows, as
/// src/render_cpu/kernel/analytic.cpp.

#include "nusselt/ltc/line_shading.glsl"
#include "nusselt/ltc/polygon_shading.glsl"
#include "passes/lights.glsl"
#include "passes/reflection.glsl"
#include "passes/shading.glsl"

/// What is reflected of an emission of 1.
/// \param integrals of the diffuse and the specular lobe over the light.
vec3 reflected_share(GlossySurface surface, vec2 integrals, inout Counts counts) {
    vec3 share = integrals.x * surface.diffuse_albedo + integrals.y * surface.specular_albedo;
    if (is_finite(share)) return share;
    ++counts.rejected_samples;
    return vec3(0.0);
}

vec3 reflected_light(Surface surface, ivec2 pixel, inout Counts counts) {
    if (kTechnique != kTechniqueLtcAnalytic) note_unknown_setting();
    GlossySurface glossy = make_reflection(surface).glossy;
    vec3 radiance = vec3(0.0);
    for (uint i = frame.first_light; kHasPolygons && i < polygons_end(); ++i) {
        LocalPolygon light = local_polygon(surface, i);
        if (!light.role.is_lit) continue;
        vec2 integrals = vec2(diffuse_integral(light.shape), clipped_lobe_integral(light.shape, glossy.lobe));
        radiance += light.role.emission * reflected_share(glossy, integrals, counts);
    }
    for (uint i = first_line(); (kHasLines || kHasTubes) && i < lines_end(); ++i) {
        LocalLine light = local_line(surface, i);
        if (!light.role.is_lit) continue;
        vec2 integrals = vec2(diffuse_integral(light.shape), clipped_lobe_integral(light.shape, glossy.lobe));
        if (kHasTubes && light.is_solid)
            integrals = vec2(tube_integral(integrals.x, light.radius), tube_integral(integrals.y, light.radius));
        radiance += light.role.emission * reflected_share(glossy, integrals, counts);
    }
    return radiance;
}

#include "passes/pixel_radiance.glsl"
