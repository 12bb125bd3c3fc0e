// What the twins of a technique return for each light. Included by the entry points after the technique.

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    uint count;
};
layout(set = 0, binding = 0, std430) readonly buffer Inputs { float inputs[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Outputs { float outputs[]; };

vec3 input_vec3(uint at) { return vec3(inputs[at], inputs[at + 1], inputs[at + 2]); }

// As nusselt::parity::DeviceOutputs.
void write_outputs(uint i, LightSample s, float pdf, vec2 inverse, float measure) {
    uint at = 12u * i;
    outputs[at] = s.wi.x;
    outputs[at + 1] = s.wi.y;
    outputs[at + 2] = s.wi.z;
    outputs[at + 3] = s.pdf;
    outputs[at + 4] = s.p.x;
    outputs[at + 5] = s.p.y;
    outputs[at + 6] = s.p.z;
    outputs[at + 7] = pdf;
    outputs[at + 8] = inverse.x;
    outputs[at + 9] = inverse.y;
    outputs[at + 10] = measure;
    outputs[at + 11] = 0.0;
}
