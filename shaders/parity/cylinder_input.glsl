// The cylinders of C++ among the inputs.
#include "parity/line_input.glsl"

const uint kCylinderSize = kLineSize + 1u;

// A Cylinder<float> of C++.
Cylinder input_cylinder(uint begin) { return Cylinder(input_line(begin), input_at(begin + kLineSize)); }
