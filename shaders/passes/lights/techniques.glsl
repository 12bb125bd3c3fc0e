#ifndef NUSSELT_PASSES_LIGHTS_TECHNIQUES_GLSL
#define NUSSELT_PASSES_LIGHTS_TECHNIQUES_GLSL
/// The techniques of the settings: number 0 for the diffuse component or for all, number 1 for the specular one. Each shape
/// of a light has a struct of techniques, which stands for a union: only the members of the techniques in use are set, and
/// the driver removes the others. Its functions have the same names for all shapes:
///
///     bool has_pair(shape, surface): whether there is a technique 1;
///     prepare_techniques(shape, surface, is_paired);
///     LightSample techniques_sample(self, technique, u);
///     vec2 techniques_pdf(self, wi): the densities of both techniques;
///     vec2 techniques_integrals(self): the integrals of the normalised components, as far as both techniques know them.

#include "passes/reflection.glsl"

const bool kIsBiased = kTechnique == kTechniqueProjectedSolidAngleBiased;
const bool kIsProjected = kIsBiased || kTechnique == kTechniqueProjectedSolidAngle; ///< lines have no biased technique
const bool kHasBrdfSamples = kStrategies == kStrategiesDiffuseGgx || kStrategies == kStrategiesDiffuseGgxBounded;
const bool kIsSolidAngle = kTechnique == kTechniqueSolidAngle || kTechnique == kTechniqueClippedSolidAngle;

/// Stands for the result where a setting has no code: black, and the renderer reports an error.
LightSample unknown_sample() {
    note_unknown_setting();
    return LightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0));
}

float unknown_number() {
    note_unknown_setting();
    return 0.0;
}

#endif
