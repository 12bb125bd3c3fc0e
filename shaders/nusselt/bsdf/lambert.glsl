#ifndef NUSSELT_BSDF_LAMBERT_GLSL
#define NUSSELT_BSDF_LAMBERT_GLSL
// Follows include/nusselt/bsdf/lambert.h @ 0f5fdca327d2
/// The Lambertian BRDF. Twin of include/nusselt/bsdf/lambert.h.

#include "../bsdf/components.glsl"

struct Lambert {
    vec3 albedo; ///< reflected fraction per colour channel, in [0, 1]
};

/// The BRDF, without the cosine [1/sr]: albedo / pi.
/// \param wi unit direction to the light in shading space; 0 where wi.z <= 0.
vec3 lambert_eval(const Lambert self, vec3 wi) { return (wi.z > 0.0 ? 0.318309886183791 : 0.0) * self.albedo; }

BrdfComponents lambert_eval_components(const Lambert self, vec3 wi) {
    return BrdfComponents(lambert_eval(self, wi), vec3(0.0));
}

#endif
