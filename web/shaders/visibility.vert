/// Draws all triangles of a scene, three vertices for each, without vertex input.

#include "scene.glsl"

uniform mat4 clip_from_world;

flat out int number;

void main() {
    number = gl_VertexID / 3;
    gl_Position = clip_from_world * vec4(triangle_corner(number, gl_VertexID % 3).xyz, 1.0);
}
