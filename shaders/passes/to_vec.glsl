#ifndef NUSSELT_PASSES_TO_VEC_GLSL
#define NUSSELT_PASSES_TO_VEC_GLSL

vec3 to_vec(const float v[3]) { return vec3(v[0], v[1], v[2]); }

#endif
