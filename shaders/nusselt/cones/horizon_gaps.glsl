#ifndef NUSSELT_CONES_HORIZON_GAPS_GLSL
#define NUSSELT_CONES_HORIZON_GAPS_GLSL
// Follows include/nusselt/cones/horizon_gaps.h @ e83904917e56
/// How far a horizon is from touching an elliptic cone. Twin of include/nusselt/cones/horizon_gaps.h.

#include "../core/vec.glsl"
#include "../geometry/precise_products.glsl"

/// (k - |nc|) / k and (k + |nc|) / k with k^2 = na^2 + nb^2, where n. is the product of a length and a height. If all but
/// a sliver of a cone is on one side of the horizon, the digits that rounding takes are all that counts in the first one.
void horizon_gaps(vec3 lengths, vec3 heights, float k, out float smaller, out float larger) {
    // Errors of products must not be denormal.
    float scale = reciprocal_power_of_two(k);
    vec3 scaled_lengths = scale * lengths;
    NUSSELT_PRECISE vec3 n = scaled_lengths * heights;
    vec3 n_error = two_product_error(scaled_lengths, heights, n);
    NUSSELT_PRECISE vec3 square = n * n;
    vec3 square_error = two_product_error(n, n, square);
    NUSSELT_PRECISE float sum = square.x + square.y;
    NUSSELT_PRECISE float difference = sum - square.z;
    float sum_error = two_sum_error(square.x, square.y, sum);
    float difference_error = two_sum_error(sum, -square.z, difference);
    float mixed = n.x * n_error.x + n.y * n_error.y - n.z * n_error.z;
    float error = (difference_error + sum_error) + (mixed + mixed);
    error += (square_error.x + square_error.y) - square_error.z;
    float scaled = scale * k;
    larger = scaled + abs(n.z);
    smaller = nusselt_max(difference + error, 0.0) / (larger * scaled);
    larger /= scaled;
}

#endif
