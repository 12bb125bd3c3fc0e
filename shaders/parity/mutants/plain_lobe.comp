#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: what it takes to cosine space cancels.
#include "nusselt/ltc/light_transform.glsl"

vec3 plain_to_cosine(const Ltc self, vec3 v) {
    return vec3(self.m00 * v.x + self.m02 * v.z, self.m11 * v.y, self.m20 * v.x + self.m22 * v.z);
}
#define ltc_to_cosine plain_to_cosine
#include "parity/functions/lobe.glsl"
