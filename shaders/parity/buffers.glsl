#ifndef PARITY_BUFFERS_GLSL
#define PARITY_BUFFERS_GLSL
// Numbers in and out, for each light or call.

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    uint count;
};
layout(set = 0, binding = 0, std430) readonly buffer Inputs { float inputs[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Outputs { float outputs[]; };

// The value of nusselt::parity::kOutputSize.
const uint kOutputSize = 12u;

vec3 input_vec3(uint at) { return vec3(inputs[at], inputs[at + 1u], inputs[at + 2u]); }

void write_vec3(uint at, vec3 v) {
    outputs[at] = v.x;
    outputs[at + 1u] = v.y;
    outputs[at + 2u] = v.z;
}

#endif
