// The lines of C++ among the inputs.
#include "parity/buffers.glsl"

const uint kLineSize = 7u;

// A LineSegment<float> of C++.
LineSegment input_line(uint begin) {
    return LineSegment(input_vec3(begin), input_vec3(begin + 3u), input_at(begin + 6u));
}
