#ifndef NUSSELT_PASSES_LIGHTS_ROUND_GLSL
#define NUSSELT_PASSES_LIGHTS_ROUND_GLSL
/// Spheres, disks, ellipses and ellipsoids as a shading point and a camera see them, as in
/// src/render_cpu/kernel/lights/round_light.h.

#ifndef ROUND_LIGHTS
#error ROUND_LIGHTS must be 1 for scenes with spheres, disks, ellipses or ellipsoids that emit, else 0: those shaders are larger
#endif

#include "nusselt/cones/round_lights.glsl"
#include "passes/lights/light_role.glsl"

layout(constant_id = kEllipsesConstant) const bool kHasEllipses = true;
layout(constant_id = kEllipsoidsConstant) const bool kHasEllipsoids = true;
const bool kHasRounds = kHasEllipses || kHasEllipsoids;

layout(set = 0, binding = kRoundLightsBinding, std430) readonly buffer RoundLights { RoundLightRecord round_lights[]; };

/// All shapes share the techniques, which know cones only: drivers would compile them once for each.
struct RoundShape {
    bool is_flat;
    vec3 center;
    vec3 axis0, axis1, axis2; ///< the last one of flat lights is 0
};

struct LocalRound {
    RoundShape shape; ///< in shading space
    LightRole role;
    uint index;         ///< among the round lights
    bool inside;        ///< whether a solid light surrounds the point
    vec3 position;      ///< of the shading point, in world space
    Frame shading;
};

Ellipse ellipse_of(const RoundShape shape) { return Ellipse(shape.center, shape.axis0, shape.axis1); }
Ellipsoid ellipsoid_of(const RoundShape shape) {
    return Ellipsoid(shape.center, shape.axis0, shape.axis1, shape.axis2);
}

RoundLightView view_without_cone(const RoundShape shape) {
    if (kHasEllipses && (!kHasEllipsoids || shape.is_flat)) return view_without_cone(ellipse_of(shape));
    return view_without_cone(ellipsoid_of(shape));
}
RoundLightView view_of(const RoundShape shape) {
    RoundLightView view = view_without_cone(shape);
    set_cone(view);
    return view;
}
RoundLightView view_of(const RoundShape shape, const Ltc lobe) {
    RoundLightView view = view_without_cone(shape);
    set_cone(view, lobe);
    return view;
}

bool is_flat(const RoundLightRecord record) { return record.shape == kDisk || record.shape == kEllipse; }

/// A light in shading space. The axes of spheres are those of this space, and those of disks depend on their normal, as in the
/// techniques for these shapes.
RoundShape local_shape(const RoundLightRecord record, const Surface surface) {
    bool flat_light = is_flat(record);
    Ellipsoid axes = to_shading_space(
        Ellipsoid(to_vec(record.center), to_vec(record.axis0), to_vec(record.axis1), to_vec(record.axis2)),
        surface.position, surface.shading);
    if (record.shape == kSphere) axes = sphere_light(axes.center, record.radius);
    RoundShape shape = RoundShape(flat_light, axes.center, axes.axis0, axes.axis1, axes.axis2);
    if (record.shape == kDisk) {
        Ellipse disk = disk_light(axes.center, frame_to_local(surface.shading, to_vec(record.normal)), record.radius);
        shape.axis0 = disk.u;
        shape.axis1 = disk.v;
    }
    return shape;
}

float highest_point(const RoundShape shape) {
    vec3 heights = vec3(shape.axis0.z, shape.axis1.z, shape.axis2.z);
    return shape.center.z + sqrt(dot(heights, heights));
}

/// A vector in the space of the unit sphere of a solid light.
vec3 in_unit_sphere(const RoundLightRecord record, vec3 v) {
    return vec3(dot(to_vec(record.inverse0), v), dot(to_vec(record.inverse1), v), dot(to_vec(record.inverse2), v));
}

/// Whether a point is on a side of a flat light that emits. The light does not light itself.
bool faces_flat_light(const RoundLightRecord record, const Surface surface, bool on_light, vec3 center) {
    if (record.emits_inwards != 0u) return !on_light;
    // Comparisons with NaN are false: negated they keep it, so that it is counted.
    return !on_light && !(dot(frame_to_local(surface.shading, to_vec(record.normal)), center) >= 0.0);
}

/// The same for a solid light. Finds whether it surrounds the point.
bool faces_solid_light(const RoundLightRecord record, const Surface surface, bool on_light, inout LocalRound light) {
    vec3 unit = in_unit_sphere(record, surface.position - to_vec(record.center));
    // Rounding puts corners of triangles to either side of the light: their front decides.
    bool faces_inwards = dot(in_unit_sphere(record, surface.geometric_normal), unit) < 0.0;
    light.inside = on_light ? faces_inwards : dot(unit, unit) < 1.0;
    bool outside = !on_light && !light.inside;
    if (record.emits_inwards == 0u) return outside;
    // A little larger, so that those corners are inside.
    float scale = light.inside ? 1.001 : 1.0;
    light.shape.axis0 *= scale;
    light.shape.axis1 *= scale;
    light.shape.axis2 *= scale;
    return light.inside || (outside && record.emits_outwards != 0u);
}

/// \param index among the round lights
LocalRound local_round(const Surface surface, uint index) {
    RoundLightRecord record = round_lights[index];
    LocalRound light;
    light.shape = local_shape(record, surface);
    light.index = index;
    light.inside = false;
    light.position = surface.position;
    light.shading = surface.shading;
    uint number = light_number(kRoundKind, index);
    bool on_light = surface.light == int(number);
    bool is_lit = light.shape.is_flat ? faces_flat_light(record, surface, on_light, light.shape.center)
                                      : faces_solid_light(record, surface, on_light, light);
    is_lit = is_lit && !(highest_point(light.shape) <= 0.0);
    light.role = LightRole(is_lit, to_vec(record.radiance), number);
    return light;
}

/// Whether a ray sees the inner side, or that to which the normal does not point.
bool sees_inner_side(const RoundLightRecord record, const Ray ray) {
    if (is_flat(record)) return !(dot(to_vec(record.normal), ray.direction) < 0.0);
    vec3 unit = in_unit_sphere(record, ray.origin - to_vec(record.center));
    return dot(unit, unit) < 1.0;
}

/// The radiance along a ray that meets the light.
vec3 round_emission(uint index, const Ray ray) {
    if (!kHasRounds) return vec3(0.0);
    RoundLightRecord record = round_lights[index];
    uint emits = sees_inner_side(record, ray) ? record.emits_inwards : record.emits_outwards;
    return emits != 0u ? to_vec(record.radiance) : vec3(0.0);
}

#endif
