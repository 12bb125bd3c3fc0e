/// The same for tubes, see analytic_polygon.glsl: thin ones, with caps as small disks.

#include "nusselt/ltc/line_shading.glsl"
#include "lights.glsl"
#include "reflection.glsl"

vec3 reflect_cylinder(Surface surface, Reflection reflection, int index) {
    Cylinder light = local_cylinder(surface, index);
    if (!is_lit(surface, light, cylinder_numbers[index])) return vec3(0.0);
    Ltc lobe = reflection.glossy.lobe;
    float diffuse = tube_integral(diffuse_integral(light.axis), light.radius,
                                  diffuse_caps_integral(light.axis, light.radius));
    float specular = tube_integral(clipped_lobe_integral(light.axis, lobe), light.radius,
                                   clipped_caps_integral(light.axis, light.radius, lobe));
    return cylinder_emission(index) *
           (diffuse * reflection.glossy.diffuse_albedo + specular * reflection.glossy.specular_albedo);
}
