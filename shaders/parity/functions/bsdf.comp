#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/bsdf/frostbite.glsl"
#include "nusselt/bsdf/lambert.glsl"
#include "parity/buffers.glsl"

// Inputs: wo, wi, albedo, f0 and roughness.
void compute(uint i) {
    vec3 wo = input_vec3(13u * i);
    vec3 wi = input_vec3(13u * i + 3u);
    vec3 albedo = input_vec3(13u * i + 6u);
    Frostbite brdf = frostbite_prepare(wo, albedo, input_vec3(13u * i + 9u), input_at(13u * i + 12u));
    write_vec3(0, frostbite_eval(brdf, wi));
    write_vec3(3, frostbite_eval_diffuse(brdf, wi));
    write_vec3(6, frostbite_eval_specular(brdf, wi));
    write_vec3(9, lambert_eval(Lambert(albedo), wi));
}
