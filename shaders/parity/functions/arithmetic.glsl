#include "parity/buffers.glsl"

// Inputs: four factors, a vector of order one or less, a vector of any length, a positive number.
void compute(uint i) {
    uint begin = 11u * i;
    vec4 f = vec4(input_at(begin), input_at(begin + 1u), input_at(begin + 2u), input_at(begin + 3u));
    vec3 moderate = input_vec3(begin + 4u);
    vec3 any = input_vec3(begin + 7u);
    results[0] = difference_of_products(f.x, f.y, f.z, f.w);
    NUSSELT_PRECISE float product = f.x * f.y;
    results[1] = two_product_error(f.x, f.y, product);
    write_vec3(2, exact_fma(f.x, moderate, vec3(f.y, f.z, f.w)));
    results[5] = inverse_length(moderate);
    results[6] = nusselt_length(any);
    write_vec3(7, nusselt_normalize(any));
    results[10] = reciprocal_power_of_two(input_at(begin + 10u));
    results[11] = atan_up_to_one(abs(f.x));
}
