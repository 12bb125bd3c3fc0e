/// Writes the number of the nearest triangle.

#include "nusselt/core/compatibility.glsl"

flat in int number;
out int visible_number;

void main() { visible_number = number; }
