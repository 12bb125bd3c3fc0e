#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
/// Integrates linearly transformed cosines over all lights, without samples and without shadows, as
/// src/render_cpu/kernel/analytic.h does.

#include "interface/fused_fma.h"
#include "passes/lights.glsl"
#include "passes/reflection.glsl"
#include "passes/shading.glsl"

/// A shading point and the light that it reflects.
struct Reflected {
    Surface surface;
    GlossySurface glossy;
    vec3 radiance;
    Counts counts;
};

/// Adds a share of what a light emits.
void add_share(inout Reflected reflected, vec3 emission, vec3 share) {
    if (is_finite(share))
        reflected.radiance += emission * share;
    else
        ++reflected.counts.rejected_samples;
}

/// Adds what the surface reflects of a light.
/// \param integrals over the light, of the diffuse and of the specular lobe
void add_light(inout Reflected reflected, const LightRole role, vec2 integrals) {
    add_share(reflected, role.emission,
              integrals.x * reflected.glossy.diffuse_albedo + integrals.y * reflected.glossy.specular_albedo);
}

#include "passes/lights/environment_integrals.glsl"
#include "passes/lights/line_integrals.glsl"
#include "passes/lights/one_direction_integrals.glsl"
#include "passes/lights/polygon_integrals.glsl"
#include "passes/rounds/round_integrals.glsl"

vec3 reflected_light(const Surface surface, ivec2 pixel, inout Counts counts) {
    if (kTechnique != kTechniqueLtcAnalytic) note_unknown_setting();
    Reflected reflected = Reflected(surface, make_reflection(surface).glossy, vec3(0.0), counts);
    ADD_ALL_LIGHTS
    counts = reflected.counts;
    return reflected.radiance;
}

#include "passes/pixel_radiance.glsl"
