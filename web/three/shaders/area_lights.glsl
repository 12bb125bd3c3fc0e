/// The light of all area lights that a fragment of a three.js material reflects.

@includes@
#ifndef NUSSELT_TUBE_LIGHTS
#define NUSSELT_TUBE_LIGHTS 0
#endif

/// \param position, normal, wo in view space.
/// \return linear radiance.
vec3 nusselt_reflected_light(PhysicalMaterial material, vec3 position, vec3 normal, vec3 wo) {
    vec3 reflected = vec3(0.0);
    Surface surface = surface_of(position, normal, wo);
    Reflection reflection = reflection_of(surface, material);
#if NUM_RECT_AREA_LIGHTS > 0
    for (int i = 0; i < polygon_count; ++i) reflected += reflect_polygon(surface, reflection, i);
#endif
#if NUSSELT_TUBE_LIGHTS
    for (int i = 0; i < line_count; ++i) reflected += reflect_line(surface, reflection, i);
#endif
    return reflected;
}
