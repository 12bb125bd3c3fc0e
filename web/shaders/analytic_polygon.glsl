/// The integral of linearly transformed cosines over polygons: no samples, no noise, no shadows.

#include "nusselt/ltc/polygon_shading.glsl"
#include "lights.glsl"
#include "reflection.glsl"

vec3 reflect_polygon(Surface surface, Reflection reflection, int index) {
    ConvexPolygon light = local_polygon(surface, index);
    if (!is_lit(surface, light, polygon_numbers[index])) return vec3(0.0);
    vec3 share = diffuse_integral(light) * reflection.glossy.diffuse_albedo +
                 clipped_lobe_integral(light, reflection.glossy.lobe) * reflection.glossy.specular_albedo;
    return polygon_emission(index) * share;
}
