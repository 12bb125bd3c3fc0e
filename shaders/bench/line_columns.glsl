// Columns of a line: start, direction and length.
#include "bench/workload.glsl"

const uint kLineColumns = 7u;

LineSegment column_line(uint index, inout vec4 sum) {
    LineSegment light;
    light.p0 = column_vec3(0u, index);
    light.s = column_vec3(3u, index);
    light.len = column(6u, index);
    sum += vec4(light.p0 + light.s, light.len);
    return light;
}
