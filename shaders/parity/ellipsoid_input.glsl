// The ellipsoids of C++ among the inputs.
#include "parity/buffers.glsl"

const uint kEllipsoidSize = 12u;

// An Ellipsoid<float> of C++.
Ellipsoid input_ellipsoid(uint begin) {
    return Ellipsoid(input_vec3(begin), input_vec3(begin + 3u), input_vec3(begin + 6u), input_vec3(begin + 9u));
}
