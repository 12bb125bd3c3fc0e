#include "parity/buffers.glsl"

void write_part(int at, const LineSegment part) {
    results[at] = part.len;
    write_vec3(at + 1, part.p0);
}

// Inputs: the begin of a line in shading space, its direction, its length, the normal of a strip, a radius and a slope.
void compute(uint i) {
    uint begin = 12u * i;
    LineSegment line = LineSegment(input_vec3(begin), input_vec3(begin + 3u), input_at(begin + 6u));
    float radius = input_at(begin + 10u);
    float slope = input_at(begin + 11u);
    write_part(0, visible_part(line, slope));
    write_part(4, visible_part_of_tube(line, radius, slope));
    write_part(8, visible_part_of_strip(line, input_vec3(begin + 7u), slope));
}
