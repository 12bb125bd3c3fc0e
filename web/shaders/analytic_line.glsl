/// The same for lines, see analytic_polygon.glsl.

#include "nusselt/ltc/line_shading.glsl"
#include "lights.glsl"
#include "reflection.glsl"

vec3 reflect_line(Surface surface, Reflection reflection, int index) {
    LineSegment light = local_line(surface, index);
    if (!is_lit(surface, light, line_numbers[index])) return vec3(0.0);
    vec3 share = diffuse_integral(light) * reflection.glossy.diffuse_albedo +
                 clipped_lobe_integral(light, reflection.glossy.lobe) * reflection.glossy.specular_albedo;
    return line_emission(index) * share;
}
