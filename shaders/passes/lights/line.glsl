#ifndef NUSSELT_PASSES_LIGHTS_LINE_GLSL
#define NUSSELT_PASSES_LIGHTS_LINE_GLSL
/// Linear lights, strips and tubes as a shading point and a camera see them, as in src/render_cpu/kernel/lights/line.cpp.

#ifndef LINE_CELLS
#error LINE_CELLS must be 1 where radiance along lines may decide where samples are, else 0: those shaders are larger
#endif

#include "nusselt/geometry/cylinder_caps.glsl"
#include "nusselt/geometry/strip.glsl"
#include "nusselt/line_emission/visible_part.glsl"
#include "passes/lights/light_role.glsl"
#include "passes/lights/line_emission_profile.glsl"
#include "passes/lights/line_profile.glsl"

// Linear lights and strips have no extent. Those whose radiance varies or depends on the direction count apart.
layout(constant_id = kLinesConstant) const bool kHasLines = true;
layout(constant_id = kTubesConstant) const bool kHasTubes = true;
const bool kHasAnyLines = kHasLines || kHasTexturedLines || kHasProfiledLines;
const bool kHasAnyTubes = kHasTubes || kHasTexturedTubes || kHasProfiledTubes;

layout(set = 0, binding = kLineLightsBinding, std430) readonly buffer LineLights { LineLightRecord line_lights[]; };

struct LocalLine {
    LineSegment shape; ///< in shading space; for tubes the axis
    uint model;
    float radius; ///< for tubes
    float width;  ///< the emission over the radiance
    LineRadiance radiance;
    LineEmissionProfile emission_profile;
    LightRole role;
};

struct LocalTube {
    Cylinder shape; ///< in shading space
    bool is_open;   ///< with dark caps
    LineRadiance radiance;
    LineEmissionProfile emission_profile;
    LightRole role;
};

bool is_tube(uint model) { return model == kSolidTube || model == kOpenTube; }
bool is_tube(const LocalLine light) { return is_tube(light.model); }

LocalTube tube_of(const LocalLine light) {
    return LocalTube(Cylinder(light.shape, light.radius), light.model == kOpenTube, light.radiance, light.emission_profile,
                     light.role);
}

/// A light without what its spread hides.
LineSegment visible_shape(const LocalLine light) {
    float inverse_slope = emission_float(light.emission_profile.profile + kProfileInverseSlope);
    if (!(inverse_slope > 0.0)) return light.shape;
    float slope = 1.0 / inverse_slope;
    if (is_tube(light)) return visible_part_of_tube(light.shape, light.radius, slope);
    if (light.model == kStrip)
        return visible_part_of_strip(light.shape, light.emission_profile.axes.normal, slope);
    return visible_part(light.shape, slope);
}

/// \param index among the lines and tubes
LocalLine local_line(const Surface surface, uint index) {
    LineLightRecord record = line_lights[index];
    LineSegment world = LineSegment(to_vec(record.begin), to_vec(record.direction), record.len);
    LocalLine light;
    light.shape = to_shading_space(world, surface.position, surface.shading);
    light.model = record.model;
    light.radius = record.radius;
    light.radiance = LineRadiance(record.first_texture_word, to_vec(record.inverse_mean));
    light.emission_profile = local_emission_profile(record.first_profile_word, surface.shading);
    if (has_emission_profile(light.emission_profile)) light.shape = visible_shape(light);
    vec3 s = light.shape.s;
    float highest = nusselt_max(light.shape.p0.z, light.shape.p0.z + light.shape.len * s.z);
    light.width = 1.0;
    if (is_tube(light))
        highest += record.radius * sqrt(nusselt_max(1.0 - s.z * s.z, 0.0));
    else
        light.width = record.radius;
    if (light.model == kStrip)
        light.width *= strip_facing(light.shape, frame_to_local(surface.shading, to_vec(record.normal)));
    light.role = LightRole(!(highest <= 0.0) && !(light.shape.len <= 0.0), light.width * to_vec(record.radiance), light_number(kLineKind, index));
    return light;
}

/// Where a ray that meets a light does so, as a share of the length. Cameras see a cylinder with flat sides: rays that miss
/// the round one have the closest point of its axis.
float place_along(const LineLightRecord record, const Cylinder tube, vec3 wi) {
    LineSegment axis = tube.axis;
    if (record.model == kStrip) {
        vec3 normal = to_vec(record.normal);
        return place_along(axis, dot(normal, axis.p0) / dot(normal, wi) * wi);
    }
    LightHit hit = intersect(tube, wi);
    if (hit.hits) return place_along(axis, hit.distance * wi);
    vec3 across = nusselt_normalize(nusselt_cross(wi, nusselt_cross(axis.s, wi)));
    return place_along(axis, nusselt_fma(-dot(axis.p0, across) / dot(axis.s, across), axis.s, axis.p0));
}

/// The part of a vector from the start of a line that is perpendicular to it.
vec3 across(const LineSegment axis, vec3 p) {
    vec3 from_start = p - axis.p0;
    return from_start - dot(from_start, axis.s) * axis.s;
}

/// The radiance of a light with a profile over its mean. \param wi unit, towards the light
float relative_radiance(const LineLightRecord record, const Cylinder tube, vec3 wi) {
    uint profile = record.first_profile_word;
    LineEmissionProfile emission_profile = LineEmissionProfile(profile, profile_axes(profile));
    LightHit hit = intersect(tube, wi);
    // Beside the round cylinder, cameras see no normal.
    if (!is_tube(record.model) || !hit.hits)
        return radiance_of_line(emission_profile, record.model == kStrip, tube.axis.s, -wi);
    vec3 normal = meets_cap(tube, wi) ? tube.axis.s : nusselt_normalize(across(tube.axis, hit.distance * wi));
    return radiance_of_tube(emission_profile, normal, -wi);
}

/// The radiance along a ray that meets the light.
vec3 line_emission(uint index, const Ray ray) {
    LineLightRecord record = line_lights[index];
    LineSegment axis = LineSegment(to_vec(record.begin) - ray.origin, to_vec(record.direction), record.len);
    Cylinder tube = Cylinder(axis, record.radius);
    vec3 wi = nusselt_normalize(ray.direction);
    if (record.model == kOpenTube && meets_cap(tube, wi)) return vec3(0.0);
    if ((kHasProfiledLines || kHasProfiledTubes) && record.first_profile_word != kNoWords)
        return relative_radiance(record, tube, wi) * to_vec(record.radiance);
    LineRadiance radiance = LineRadiance(record.first_texture_word, to_vec(record.inverse_mean));
    if (!varies(radiance)) return to_vec(record.radiance);
    return line_profile_lookup(radiance.profile, place_along(record, tube, wi));
}

#endif
