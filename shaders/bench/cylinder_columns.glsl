// Columns of a cylinder: those of its axis, and the radius.
#include "bench/line_columns.glsl"

const uint kCylinderColumns = kLineColumns + 1u;

Cylinder column_cylinder(uint index, inout vec4 sum) {
    const float radius = column(kLineColumns, index);
    sum.w += radius;
    return Cylinder(column_line(index, sum), radius);
}
