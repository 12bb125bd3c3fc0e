// The ellipses of C++ among the inputs.
#include "parity/buffers.glsl"

const uint kEllipseSize = 9u;

// An Ellipse<float> of C++.
Ellipse input_ellipse(uint begin) {
    return Ellipse(input_vec3(begin), input_vec3(begin + 3u), input_vec3(begin + 6u));
}
