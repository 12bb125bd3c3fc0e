#ifndef NUSSELT_CONES_ROUND_LIGHTS_GLSL
#define NUSSELT_CONES_ROUND_LIGHTS_GLSL
// Follows include/nusselt/cones/round_lights.h @ b35b2e967567
/// Spheres, disks, ellipses and ellipsoids as lights, and what a point sees of them: an elliptic cone, and the way
/// from a point of its disk back to the light. Twin of include/nusselt/cones/round_lights.h, which has types of their
/// own for spheres and disks.

#include "../cones/elliptic_cone.glsl"
#include "../ltc/ltc.glsl"

/// The points center + sigma u + tau v with sigma^2 + tau^2 <= 1. Both sides are the same to techniques.
struct Ellipse {
    vec3 center; ///< [m]
    vec3 u, v;   ///< conjugate semi-diameters, which need not be perpendicular [m]
};

/// The points center + x axis0 + y axis1 + z axis2 with x^2 + y^2 + z^2 <= 1. From inside, all directions lead to it.
struct Ellipsoid {
    vec3 center;              ///< [m]
    vec3 axis0, axis1, axis2; ///< conjugate semi-diameters, which need not be perpendicular [m]
};

/// \param normal unit.
/// \param radius [m]
Ellipse disk_light(vec3 center, vec3 normal, float radius) {
    Frame frame = frame_from_normal(normal);
    return Ellipse(center, radius * frame.t, radius * frame.b);
}

/// \param radius [m]
Ellipsoid sphere_light(vec3 center, float radius) {
    return Ellipsoid(center, vec3(radius, 0.0, 0.0), vec3(0.0, radius, 0.0), vec3(0.0, 0.0, radius));
}

/// The light seen from a shading point: the point becomes the origin, the normal of the frame +z.
Ellipse to_shading_space(const Ellipse world, vec3 point, const Frame frame) {
    return Ellipse(frame_to_local(frame, world.center - point), frame_to_local(frame, world.u),
                   frame_to_local(frame, world.v));
}
Ellipsoid to_shading_space(const Ellipsoid world, vec3 point, const Frame frame) {
    return Ellipsoid(frame_to_local(frame, world.center - point), frame_to_local(frame, world.axis0),
                     frame_to_local(frame, world.axis1), frame_to_local(frame, world.axis2));
}

/// A light as the origin sees it. In the space of the unit sphere, the tangent cone of an ellipsoid touches a circle;
/// flat lights are one at infinity: w = 0, closeness 0.
struct RoundLightView {
    EllipticCone cone;
    vec3 center, w, u, v; ///< in the space of the unit sphere, w leads to the centre; u and v are perpendicular to w
    vec3 inverse0, inverse1, inverse2; ///< rows of the inverse of (w u v), for rays from inside
    float closeness;                   ///< one over the distance of the centre in the space of the unit sphere
    float rim;                         ///< sqrt(1 - closeness^2)
    bool is_inside;                    ///< whether the light surrounds the origin
    float inverse_scale;               ///< a power of two
};

/// The point of the light that belongs to a point of the disk of the cone, the closer one of two; from inside, where
/// a ray leaves the light. Scaled; tiny and near lights do not cancel.
vec3 round_light_point(const RoundLightView self, vec2 disk, vec3 wi) {
    if (self.is_inside) {
        // |t d - y| = 1 with the direction d and the centre y in the space of the unit sphere.
        vec3 d = vec3(dot(self.inverse0, wi), dot(self.inverse1, wi), dot(self.inverse2, wi));
        float y = 1.0 / nusselt_max(self.closeness, 1.0);
        float squared = dot(d, d);
        float along = d.x * y;
        float root = sqrt(nusselt_max(nusselt_fma(along, along, squared * ((1.0 - y) * (1.0 + y))), 0.0));
        // Rounding next to a flat light must not lead far away.
        float farthest = nusselt_length(self.center) + nusselt_length(self.w) + nusselt_length(self.u) +
                         nusselt_length(self.v);
        return nusselt_min(over_positive(root + along, squared), farthest) * wi;
    }
    vec2 p = elliptic_cone_to_light(self.cone, disk);
    float kappa = sqrt(nusselt_max(1.0 - dot(p, p), 0.0));
    float inverse_sum = 1.0 / (1.0 + kappa * self.closeness);
    float back = (self.closeness + kappa) * inverse_sum;
    float lateral = self.rim * inverse_sum;
    return self.center + ((lateral * p.x) * self.u + (lateral * p.y) * self.v - back * self.w);
}

/// The view without its cone.
RoundLightView view_without_cone(const Ellipse light) {
    float size = nusselt_max(largest_component(light.u), largest_component(light.v));
    float scale = reciprocal_power_of_two(nusselt_max(largest_component(light.center), size));
    RoundLightView self;
    self.center = scale * light.center;
    self.u = scale * light.u;
    self.v = scale * light.v;
    self.w = vec3(0.0);
    self.inverse0 = vec3(0.0);
    self.inverse1 = vec3(0.0);
    self.inverse2 = vec3(0.0);
    self.closeness = 0.0;
    self.rim = 1.0;
    self.is_inside = false;
    self.inverse_scale = reciprocal_power_of_two(scale);
    self.cone.is_visible = true;
    return self;
}

/// \copydoc view_without_cone(Ellipse)
/// An ellipsoid without volume is invisible.
RoundLightView view_without_cone(const Ellipsoid light) {
    float size = nusselt_max(nusselt_max(largest_component(light.axis0), largest_component(light.axis1)),
                             largest_component(light.axis2));
    float scale = reciprocal_power_of_two(nusselt_max(largest_component(light.center), size));
    RoundLightView self;
    self.center = scale * light.center;
    self.inverse_scale = reciprocal_power_of_two(scale);

    // Find the centre in the space of the unit sphere. Axes of order one keep the determinant in range.
    float up = reciprocal_power_of_two(size);
    vec3 a = up * light.axis0;
    vec3 b = up * light.axis1;
    vec3 c = up * light.axis2;
    vec3 bc = nusselt_cross(b, c);
    vec3 ca = nusselt_cross(c, a);
    vec3 ab = nusselt_cross(a, b);
    float volume = dot(a, bc);
    // Of coplanar semi-diameters, the volume is a matter of rounding.
    bool solid = abs(volume) > nusselt_max((4.0 * kNusseltEpsilon) * dot(abs(a), abs(bc)), kNusseltTiny);
    float inverse_volume = 1.0 / (solid ? volume : 1.0);
    vec3 unit = inverse_volume * vec3(dot(bc, self.center), dot(ca, self.center), dot(ab, self.center));
    float down = scale * reciprocal_power_of_two(up); // how large the axes are
    float distance = nusselt_length(unit);
    self.is_inside = solid && distance < down;
    float safe = distance > 0.0 ? distance : 1.0;
    Frame frame = frame_from_normal(distance > 0.0 ? nusselt_normalize(unit) : vec3(0.0, 0.0, 1.0));
    self.closeness = down / nusselt_max(distance, kNusseltSmallestNormal);
    self.rim = sqrt(nusselt_max((distance - down) * (distance + down), 0.0)) / safe;
    self.w = down * (frame.n.x * a + (frame.n.y * b + frame.n.z * c));
    self.u = down * (frame.t.x * a + (frame.t.y * b + frame.t.z * c));
    self.v = down * (frame.b.x * a + (frame.b.y * b + frame.b.z * c));
    float inverse = inverse_volume / (down > 0.0 ? down : 1.0);
    self.inverse0 = inverse * (frame.n.x * bc + (frame.n.y * ca + frame.n.z * ab));
    self.inverse1 = inverse * (frame.t.x * bc + (frame.t.y * ca + frame.t.z * ab));
    self.inverse2 = inverse * (frame.b.x * bc + (frame.b.y * ca + frame.b.z * ab));
    self.cone.is_visible = solid;
    return self;
}

/// Completes a view by the cone of the columns of the light in the space where it is seen.
void set_cone(inout RoundLightView self, vec3 u, vec3 v, vec3 rim_center, vec3 front) {
    bool has_extent = self.cone.is_visible;
    self.cone = cone_of_ellipse(u, v, rim_center, front);
    self.cone.is_visible = self.cone.is_visible && has_extent;
    if (self.is_inside) {
        // From inside, the light fills all directions: the cone is the upper half-space.
        self.cone.e1 = vec3(1.0, 0.0, 0.0);
        self.cone.e2 = vec3(0.0, 1.0, 0.0);
        self.cone.e3 = vec3(0.0, 0.0, 1.0);
        self.cone.a = 1.0;
        self.cone.b = 1.0;
        self.cone.c = 0.0;
    }
}

/// The view in the space of the light.
void set_cone(inout RoundLightView self) { set_cone(self, self.u, self.v, self.rim * self.center, self.center); }

/// The cone is that of the cosine space of a lobe.
void set_cone(inout RoundLightView self, const Ltc ltc) {
    set_cone(self, ltc_to_cosine(ltc, self.u), ltc_to_cosine(ltc, self.v), ltc_to_cosine(ltc, self.rim * self.center),
             ltc_to_cosine(ltc, self.center));
}

RoundLightView view_of(const Ellipse light) {
    RoundLightView view = view_without_cone(light);
    set_cone(view);
    return view;
}
RoundLightView view_of(const Ellipsoid light) {
    RoundLightView view = view_without_cone(light);
    set_cone(view);
    return view;
}
RoundLightView view_of(const Ellipse light, const Ltc ltc) {
    RoundLightView view = view_without_cone(light);
    set_cone(view, ltc);
    return view;
}
RoundLightView view_of(const Ellipsoid light, const Ltc ltc) {
    RoundLightView view = view_without_cone(light);
    set_cone(view, ltc);
    return view;
}

#endif
