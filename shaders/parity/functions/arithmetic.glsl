#include "parity/buffers.glsl"

// Inputs: four factors, a vector of order one or less, a vector of any length, a positive number.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = 11u * i;
    const vec4 f = vec4(inputs[begin], inputs[begin + 1u], inputs[begin + 2u], inputs[begin + 3u]);
    const vec3 moderate = input_vec3(begin + 4u);
    const vec3 any = input_vec3(begin + 7u);
    const uint at = kOutputSize * i;
    outputs[at] = difference_of_products(f.x, f.y, f.z, f.w);
    NUSSELT_PRECISE float product = f.x * f.y;
    outputs[at + 1u] = two_product_error(f.x, f.y, product);
    write_vec3(at + 2u, exact_fma(f.x, moderate, vec3(f.y, f.z, f.w)));
    outputs[at + 5u] = inverse_length(moderate);
    outputs[at + 6u] = nusselt_length(any);
    write_vec3(at + 7u, nusselt_normalize(any));
    outputs[at + 10u] = reciprocal_power_of_two(inputs[begin + 10u]);
    outputs[at + 11u] = atan_up_to_one(abs(f.x));
}
