#version 450
#extension GL_GOOGLE_include_directive : require
// Whether fma rounds once: see src/gpu/fused_fma.h.
#include "nusselt/core/real.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Operands { float operands[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Results { uint results[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    results[i] = nusselt_fma_is_fused(operands[i]) ? 1u : 0u;
}
