#ifndef NUSSELT_PASSES_LIGHTS_TECHNIQUES_GLSL
#define NUSSELT_PASSES_LIGHTS_TECHNIQUES_GLSL
/// The techniques of the settings: number 0 for the diffuse component or for all, number 1 for the specular one. Each shape
/// of a light has a struct of techniques, which stands for a union: of its members, those of the techniques in use are
/// set, and the driver removes the others. Functions on it have the same names for all shapes:
///
///     bool has_pair(shape, surface): whether there is a technique 1;
///     prepare_techniques(shape, surface, is_paired);
///     LightSample techniques_sample(self, technique, u);
///     vec2 techniques_pdf(self, wi): of both techniques;
///     vec2 techniques_integrals(self): what both techniques know of the integrals of the normalised components.

#include "passes/reflection.glsl"

const bool kIsBiased = kTechnique == kTechniqueProjectedSolidAngleBiased;
const bool kIsProjected = kIsBiased || kTechnique == kTechniqueProjectedSolidAngle; ///< as lines see it
const bool kHasBrdfSamples = kStrategies == kStrategiesDiffuseGgx || kStrategies == kStrategiesDiffuseGgxBounded;
const bool kIsSolidAngle = kTechnique == kTechniqueSolidAngle || kTechnique == kTechniqueClippedSolidAngle;

/// Where a setting has no code: black, and an error of the renderer.
LightSample unknown_sample() {
    note_unknown_setting();
    return LightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0));
}

float unknown_number() {
    note_unknown_setting();
    return 0.0;
}

#endif
