#ifndef PAGE_REFLECTION_GLSL
#define PAGE_REFLECTION_GLSL
/// The BRDF of a three.js material as its RectAreaLights see it, in place of the file of the live page: Lambert plus
/// GGX, neither of which takes energy from the other.

#include "specular_fit.glsl"
#include "surface.glsl"

struct Reflection {
    PhysicalMaterial material; ///< with its tangents in shading space
    GlossySurface glossy;      ///< directions, lobe, and estimates of albedos
};

/// \param material with roughness above 0, as three.js prepares it.
Reflection reflection_of(Surface surface, PhysicalMaterial material) {
    Reflection self;
    self.material = material;
#ifdef USE_ANISOTROPY
    self.material.anisotropyT = frame_to_local(surface.shading, to_world(material.anisotropyT));
    self.material.anisotropyB = frame_to_local(surface.shading, to_world(material.anisotropyB));
#endif
    float f90 = material.specularF90;
    // Reflectance between f0 and f90 is f90 times that between their ratio and 1.
    vec3 f0 = material.specularColorBlended / max(f90, EPSILON);
    SpecularFit fit = specular_fit(material.roughness, surface.cos_o, f0);
    fit.albedo *= f90;
    self.glossy = make_glossy_surface(surface.cos_o, material.diffuseContribution, f0, material.roughness, fit);
    self.glossy.diffuse_albedo = material.diffuseContribution;
    return self;
}

BrdfComponents reflection_eval_components(Reflection self, vec3 wi) {
    return BrdfComponents(BRDF_Lambert(self.material.diffuseContribution),
                          BRDF_GGX(wi, self.glossy.wo, vec3(0.0, 0.0, 1.0), self.material));
}

#endif
