#ifndef PARITY_BUFFERS_GLSL
#define PARITY_BUFFERS_GLSL
// Numbers in and out, for each light or call: buffers in Vulkan, textures in WebGL 2.

// The value of nusselt::parity::kOutputSize.
const uint kOutputSize = 12u;
float results[kOutputSize];

// Each entry point defines this: it reads the inputs of light or call number i and fills in the results. Others are 0.
void compute(uint i);

void compute_results(uint i) {
    for (uint k = 0u; k < kOutputSize; ++k) results[k] = 0.0;
    compute(i);
}

#ifdef GL_ES
// The bits of floats are integers in textures, because textures of floats need not preserve denormal numbers and NaN.
// The sizes are those of tests/parity/browser/shaders.js.
const uint kRowSize = 2048u; // texels
const uint kResultsInRow = 256u;
uint texel_at(highp usampler2D rows, uint at) {
    return texelFetch(rows, ivec2(at % kRowSize, at / kRowSize), 0).x;
}

uniform uint count;
uniform highp usampler2D inputs;
float input_at(uint at) { return uintBitsToFloat(texel_at(inputs, at)); }

layout(location = 0) out uvec4 first_results;
layout(location = 1) out uvec4 second_results;
layout(location = 2) out uvec4 third_results;

uvec4 bits_of_results(int begin) {
    return floatBitsToUint(vec4(results[begin], results[begin + 1], results[begin + 2], results[begin + 3]));
}

void main() {
    uint i = uint(gl_FragCoord.y) * kResultsInRow + uint(gl_FragCoord.x);
    if (i >= count) return; // without inputs, loops could take forever
    compute_results(i);
    first_results = bits_of_results(0);
    second_results = bits_of_results(4);
    third_results = bits_of_results(8);
}
#else
layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
    uint count;
};
layout(set = 0, binding = 0, std430) readonly buffer Inputs { float inputs[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Outputs { float outputs[]; };

float input_at(uint at) { return inputs[at]; }

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    compute_results(i);
    for (uint k = 0u; k < kOutputSize; ++k) outputs[kOutputSize * i + k] = results[k];
}
#endif

vec3 input_vec3(uint at) { return vec3(input_at(at), input_at(at + 1u), input_at(at + 2u)); }

void write_vec3(int at, vec3 v) {
    results[at] = v.x;
    results[at + 1] = v.y;
    results[at + 2] = v.z;
}

#endif
