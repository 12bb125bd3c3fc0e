#version 450
// Computes, for the tests of buffers, push constants and specialisation constants, scale (a + b) + offset + step i.

layout(local_size_x = 64) in;
layout(constant_id = 0) const float offset = 0.0;
layout(constant_id = 1) const uint step_size = 0u;
layout(push_constant) uniform Push {
    float scale;
    uint count;
};
layout(set = 0, binding = 0, std430) readonly buffer A { float a[]; };
layout(set = 0, binding = 1, std430) readonly buffer B { float b[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Sums { float sums[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < count) sums[i] = scale * (a[i] + b[i]) + offset + float(step_size * i);
}
