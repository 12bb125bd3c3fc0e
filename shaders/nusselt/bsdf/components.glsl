#ifndef NUSSELT_BSDF_COMPONENTS_GLSL
#define NUSSELT_BSDF_COMPONENTS_GLSL
// Follows include/nusselt/bsdf/components.h @ 8c07436b712d
/// The parts of a BRDF that samplers distinguish. Twin of include/nusselt/bsdf/components.h.

#include "../core/compatibility.glsl"

/// Values of a BRDF by component, without the cosine [1/sr].
struct BrdfComponents {
    vec3 diffuse;
    vec3 specular;
};

#endif
