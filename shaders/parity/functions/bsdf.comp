#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/bsdf/frostbite.glsl"
#include "nusselt/bsdf/lambert.glsl"
#include "parity/buffers.glsl"

// Inputs: wo, wi, albedo, f0 and roughness.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const vec3 wo = input_vec3(13u * i);
    const vec3 wi = input_vec3(13u * i + 3u);
    const vec3 albedo = input_vec3(13u * i + 6u);
    const Frostbite brdf = frostbite_prepare(wo, albedo, input_vec3(13u * i + 9u), inputs[13u * i + 12u]);
    write_vec3(kOutputSize * i, frostbite_eval(brdf, wi));
    write_vec3(kOutputSize * i + 3u, frostbite_eval_diffuse(brdf, wi));
    write_vec3(kOutputSize * i + 6u, frostbite_eval_specular(brdf, wi));
    write_vec3(kOutputSize * i + 9u, lambert_eval(Lambert(albedo), wi));
}
