#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_UNIFORM_INTEGRALS_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_UNIFORM_INTEGRALS_GLSL
/// Integrals over polygonal lights without images.

void add_polygon(inout Reflected reflected, const LocalPolygon light) {
    add_light(reflected, light.role, lobe_integrals(light.shape, reflected.glossy.lobe));
}

#endif
