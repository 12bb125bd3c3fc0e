#version 450
// Whether fma rounds once: see src/gpu/fused_fma.h. The operands come from outside, so that no compiler folds them.

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Operands { vec2 operands[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Results { float results[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    const vec2 a = operands[i];
    precise float result = fma(a.x, a.x, a.y);
    results[i] = result;
}
