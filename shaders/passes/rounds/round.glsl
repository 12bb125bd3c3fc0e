#ifndef NUSSELT_PASSES_ROUNDS_ROUND_GLSL
#define NUSSELT_PASSES_ROUNDS_ROUND_GLSL
/// Spheres, disks, ellipses and ellipsoids as a shading point and a camera see them, as in
/// src/render_cpu/kernel/lights/round_light.h.

#include "passes/scene.glsl"

#if ROUND_LIGHTS
#include "nusselt/cones/circular_cones.glsl"
#include "nusselt/cones/round_lights.glsl"
#include "passes/lights/light_role.glsl"
#include "passes/rounds/round_surface.glsl"

/// All shapes share the techniques, which know cones only: drivers would compile them once for each.
struct RoundShape {
    bool is_flat;
    bool is_circular; ///< sphere or disk
    vec3 center;
    vec3 axis0, axis1, axis2; ///< the last one of flat lights is 0
    vec3 normal;  ///< of flat lights
    float radius; ///< of spheres and disks
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
/// Disks with the semi-diameters of disk_light(), which the techniques of C++ take where they need no cone of the point.
Ellipse fixed_ellipse_of(const RoundShape shape) {
    if (shape.is_circular) return disk_light(shape.center, shape.normal, shape.radius);
    return ellipse_of(shape);
}
Ellipsoid ellipsoid_of(const RoundShape shape) {
    return Ellipsoid(shape.center, shape.axis0, shape.axis1, shape.axis2);
}

RoundLightView view_without_cone(const RoundShape shape) {
    if (kHasEllipses && (!kHasEllipsoids || shape.is_flat)) return view_without_cone(ellipse_of(shape));
    return view_without_cone(ellipsoid_of(shape));
}
/// The cone of a sphere that does not surround the point.
EllipticCone cone_of_sphere(const RoundLightView view, float radius) {
    float inverse = over_positive(1.0, radius);
    Frame frame = Frame(inverse * view.u, inverse * view.v, inverse * view.w);
    EllipticCone cone = cone_of_circle(frame, nusselt_min(view.closeness, 1.0), view.rim);
    cone.is_visible = cone.is_visible && radius > 0.0;
    return cone;
}
RoundLightView view_of(const RoundShape shape) {
    RoundLightView view = view_without_cone(shape);
    float radius = shape.radius / view.inverse_scale;
    if (shape.is_circular && shape.is_flat)
        view.cone = cone_of_disk(view.center, shape.normal, radius);
    else if (shape.is_circular && !view.is_inside)
        view.cone = cone_of_sphere(view, radius);
    else
        set_cone(view);
    return view;
}
/// In the cosine space of a lobe.
RoundLightView view_of(RoundShape shape, const Ltc lobe) {
    if (shape.is_flat) {
        Ellipse ellipse = fixed_ellipse_of(shape);
        shape.axis0 = ellipse.u;
        shape.axis1 = ellipse.v;
    }
    RoundLightView view = view_without_cone(shape);
    set_cone(view, lobe);
    return view;
}

/// A light in shading space. The axes of spheres and disks are those of the techniques of C++ for these shapes.
RoundShape local_shape(uint light, const Surface surface) {
    Ellipsoid axes = to_shading_space(
        Ellipsoid(to_vec(round_lights[light].center), to_vec(round_lights[light].axis0),
                  to_vec(round_lights[light].axis1), to_vec(round_lights[light].axis2)),
        surface.position, surface.shading);
    uint kind = round_lights[light].shape;
    RoundShape shape;
    shape.is_flat = is_flat(light);
    shape.is_circular = kind == kSphere || kind == kDisk;
    shape.center = axes.center;
    shape.normal = frame_to_local(surface.shading, to_vec(round_lights[light].normal));
    shape.radius = round_lights[light].radius;
    if (kind == kSphere) axes = sphere_light(axes.center, shape.radius);
    shape.axis0 = axes.axis0;
    shape.axis1 = axes.axis1;
    shape.axis2 = axes.axis2;
    if (kHasEllipses && kind == kDisk) {
        DiskDirections disk = disk_directions(shape.center, shape.normal);
        shape.axis0 = shape.radius * disk.along;
        shape.axis1 = shape.radius * disk.across;
    }
    return shape;
}

float highest_point(const RoundShape shape) {
    if (shape.is_circular) {
        float across = shape.is_flat ? sqrt(dot(shape.normal.xy, shape.normal.xy)) : 1.0;
        return shape.center.z + shape.radius * across;
    }
    vec3 heights = vec3(shape.axis0.z, shape.axis1.z, shape.axis2.z);
    return shape.center.z + sqrt(dot(heights, heights));
}

/// Whether a point is on a side of a flat light that emits. The light does not light itself.
bool faces_flat_light(bool emits_inwards, bool on_light, const RoundShape shape) {
    if (emits_inwards) return !on_light;
    // Comparisons with NaN are false: negated they keep it, so that it is counted.
    return !on_light && !(dot(shape.normal, shape.center) >= 0.0);
}

/// The same for a solid light. Finds whether it surrounds the point.
bool faces_solid_light(const Surface surface, bool on_light, inout LocalRound light) {
    vec3 unit = in_unit_sphere(light.index, surface.position - to_vec(round_lights[light.index].center));
    // Rounding puts points on the light to either side of it: the normal towards the eye decides.
    bool faces_inwards = dot(in_unit_sphere(light.index, surface.geometric_normal), unit) < 0.0;
    light.inside = on_light ? faces_inwards : dot(unit, unit) < 1.0;
    bool outside = !on_light && !light.inside;
    if (round_lights[light.index].emits_inwards == 0u) return outside;
    // A little larger, so that those points are inside.
    float scale = light.inside ? 1.001 : 1.0;
    light.shape.axis0 *= scale;
    light.shape.axis1 *= scale;
    light.shape.axis2 *= scale;
    light.shape.radius *= scale;
    return light.inside || (outside && round_lights[light.index].emits_outwards != 0u);
}

/// \param index among the round lights
LocalRound local_round(const Surface surface, uint index) {
    LocalRound light;
    light.shape = local_shape(index, surface);
    light.index = index;
    light.inside = false;
    light.position = surface.position;
    light.shading = surface.shading;
    uint number = light_number(kRoundKind, index);
    bool on_light = surface.light == int(number);
    bool emits_inwards = round_lights[index].emits_inwards != 0u;
    bool is_lit = light.shape.is_flat ? faces_flat_light(emits_inwards, on_light, light.shape)
                                      : faces_solid_light(surface, on_light, light);
    is_lit = is_lit && !(highest_point(light.shape) <= 0.0);
    light.role = LightRole(is_lit, to_vec(round_lights[index].radiance), number);
    return light;
}

/// Whether a ray sees the inner side, or that to which the normal does not point.
bool sees_inner_side(uint light, const Ray ray) {
    if (is_flat(light)) return !(dot(to_vec(round_lights[light].normal), ray.direction) < 0.0);
    vec3 unit = in_unit_sphere(light, ray.origin - to_vec(round_lights[light].center));
    return dot(unit, unit) < 1.0;
}

/// The radiance along a ray that meets the light.
vec3 round_emission(uint index, const Ray ray) {
    if (!kHasRounds) return vec3(0.0); // drivers then drop the rest
    uint emits = sees_inner_side(index, ray) ? round_lights[index].emits_inwards : round_lights[index].emits_outwards;
    return emits != 0u ? to_vec(round_lights[index].radiance) : vec3(0.0);
}
#else
vec3 round_emission(uint index, const Ray ray) { return vec3(0.0); }
#endif

#endif
