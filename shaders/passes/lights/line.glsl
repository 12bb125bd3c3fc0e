#ifndef NUSSELT_PASSES_LIGHTS_LINE_GLSL
#define NUSSELT_PASSES_LIGHTS_LINE_GLSL
/// Linear lights and tubes as a shading point and a camera see them, as in src/render_cpu/kernel/lights/line.cpp.

#include "nusselt/geometry/cylinder.glsl"
#include "nusselt/geometry/line_segment.glsl"
#include "passes/lights/light_role.glsl"

layout(constant_id = kLinesConstant) const bool kHasLines = true; ///< linear lights without extent
layout(constant_id = kTubesConstant) const bool kHasTubes = true;

layout(set = 0, binding = kLineLightsBinding, std430) readonly buffer LineLights { LineLightRecord line_lights[]; };

struct LocalLine {
    LineSegment shape; ///< in shading space; for tubes the axis
    bool is_solid;     ///< a tube, not a linear light
    float radius;      ///< for tubes
    LightRole role;
};

struct LocalTube {
    Cylinder shape; ///< in shading space
    LightRole role;
};

LocalTube tube_of(LocalLine light) { return LocalTube(Cylinder(light.shape, light.radius), light.role); }

/// \param index among the lines and tubes
LocalLine local_line(Surface surface, uint index) {
    LineLightRecord record = line_lights[index];
    LineSegment world = LineSegment(to_vec(record.begin), to_vec(record.direction), record.len);
    LineSegment local = to_shading_space(world, surface.position, surface.shading);
    bool is_solid = record.is_solid != 0u;
    float highest = nusselt_max(local.p0.z, local.p0.z + local.len * local.s.z);
    if (is_solid) highest += record.radius * sqrt(nusselt_max(1.0 - local.s.z * local.s.z, 0.0));
    vec3 emission = to_vec(record.radiance);
    if (!is_solid) emission = record.radius * emission;
    return LocalLine(local, is_solid, record.radius, LightRole(!(highest <= 0.0), emission, light_number(kLineKind, index)));
}

/// The radiance along a ray that meets the light.
vec3 line_emission(uint index, vec3 direction) { return to_vec(line_lights[index].radiance); }

#endif
