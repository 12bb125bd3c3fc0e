#ifndef NUSSELT_PASSES_LIGHTS_LINE_GLSL
#define NUSSELT_PASSES_LIGHTS_LINE_GLSL
/// Linear lights, strips and tubes as a shading point and a camera see them, as in src/render_cpu/kernel/lights/line.cpp.

#include "nusselt/geometry/cylinder_caps.glsl"
#include "nusselt/geometry/strip.glsl"
#include "passes/lights/light_role.glsl"

layout(constant_id = kLinesConstant) const bool kHasLines = true; ///< linear lights and strips, without extent
layout(constant_id = kTubesConstant) const bool kHasTubes = true;

layout(set = 0, binding = kLineLightsBinding, std430) readonly buffer LineLights { LineLightRecord line_lights[]; };

struct LocalLine {
    LineSegment shape; ///< in shading space; for tubes the axis
    uint model;
    float radius; ///< for tubes
    LightRole role;
};

struct LocalTube {
    Cylinder shape; ///< in shading space
    bool is_open;   ///< with dark caps
    LightRole role;
};

bool is_tube(LocalLine light) { return light.model == kSolidTube || light.model == kOpenTube; }

LocalTube tube_of(LocalLine light) {
    return LocalTube(Cylinder(light.shape, light.radius), light.model == kOpenTube, light.role);
}

/// \param index among the lines and tubes
LocalLine local_line(Surface surface, uint index) {
    LineLightRecord record = line_lights[index];
    LineSegment world = LineSegment(to_vec(record.begin), to_vec(record.direction), record.len);
    LocalLine light;
    light.shape = to_shading_space(world, surface.position, surface.shading);
    light.model = record.model;
    light.radius = record.radius;
    vec3 s = light.shape.s;
    float highest = nusselt_max(light.shape.p0.z, light.shape.p0.z + light.shape.len * s.z);
    vec3 emission = to_vec(record.radiance);
    if (is_tube(light))
        highest += record.radius * sqrt(nusselt_max(1.0 - s.z * s.z, 0.0));
    else
        emission = record.radius * emission;
    if (light.model == kStrip)
        emission *= strip_facing(light.shape, frame_to_local(surface.shading, to_vec(record.normal)));
    light.role = LightRole(!(highest <= 0.0), emission, light_number(kLineKind, index));
    return light;
}

/// The radiance along a ray that meets the light.
vec3 line_emission(uint index, Ray ray) {
    LineLightRecord record = line_lights[index];
    LineSegment axis = LineSegment(to_vec(record.begin) - ray.origin, to_vec(record.direction), record.len);
    bool is_dark = record.model == kOpenTube && meets_cap(Cylinder(axis, record.radius), ray.direction);
    return is_dark ? vec3(0.0) : to_vec(record.radiance);
}

#endif
