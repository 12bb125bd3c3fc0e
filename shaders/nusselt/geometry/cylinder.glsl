#ifndef NUSSELT_GEOMETRY_CYLINDER_GLSL
#define NUSSELT_GEOMETRY_CYLINDER_GLSL
// Follows include/nusselt/geometry/cylinder.h @ d9418414ff6e
/// Solid cylinders, and the rectangles that half-planes through a shading point cut out of them. Twin of
/// include/nusselt/geometry/cylinder.h.

#include "../geometry/clip_line.glsl"

/// A tubular light of finite radius: a cylinder that is closed by flat caps and emits outwards, also from its caps. A
/// point inside receives no light.
struct Cylinder {
    LineSegment axis; ///< from the middle of one cap to that of the other
    float radius;     ///< [m]
};

/// The cylinder seen from a shading point: the point becomes the origin, the normal of the frame +z.
Cylinder to_shading_space(const Cylinder world, vec3 point, const Frame frame) {
    return Cylinder(to_shading_space(world.axis, point, frame), world.radius);
}

/// Power of two that brings the coordinates of a cylinder to order one, so that their squares stay in range.
float scale_of(const Cylinder cylinder) {
    float extent = nusselt_max(cylinder.axis.len, cylinder.radius);
    return reciprocal_power_of_two(nusselt_max(largest_component(cylinder.axis.p0), extent));
}

Cylinder scaled(const Cylinder cylinder, float scale) {
    return Cylinder(scaled(cylinder.axis, scale), scale * cylinder.radius);
}

/// The intersection of the half-plane of points l s + rho t, rho >= 0, through the origin with an infinite cylinder
/// with axis direction s: the strip of rho in [near, far].
struct CylinderSlice {
    vec2 azimuth;     ///< t in the basis m, n of the view
    vec3 t;           ///< unit, perpendicular to the axis
    float offset;     ///< of the half-plane from the axis, to the left of t if s points to the eye
    float half_chord; ///< half the width of the strip outside the cylinder
    float near, far;  ///< near is 0 inside the infinite cylinder
    bool meets;       ///< false if the half-plane misses the cylinder; it then touches it
};

/// A cylinder as the origin sees it. Lengths are those of the cylinder, which shall have coordinates of order one
/// (scaled()).
struct CylinderView {
    vec3 s, m, n; ///< right-handed, orthonormal; s is the direction of the axis
    vec2 center;  ///< where the infinite axis passes, in the basis m, n
    float radius;
    float gap, sum;       ///< distance from the axis minus and plus the radius
    vec3 start, end;      ///< of the axis
    float l0, l1, len;    ///< coordinates of start and end along s, and their difference
    vec2 touching;        ///< unit, from outside: the half-plane that touches on the side of n
    float cotangent;      ///< of its angle from m; 0 from inside
    bool outside;         ///< of the infinite cylinder; m then leads to its axis
    bool visible;         ///< false inside, on the surface next to it, and for a cylinder without length or radius
};

/// \param cylinder with coordinates of order one.
/// \param up       to which m leads as far as it can where the axis does not tell; may be zero.
CylinderView make_cylinder_view(const Cylinder cylinder, vec3 up) {
    LineSegment axis = cylinder.axis;
    CylinderView v;
    v.s = axis.s;
    v.start = axis.p0;
    v.end = end_of(axis);
    v.len = axis.len;
    v.radius = cylinder.radius;
    vec3 moment = nusselt_cross(axis.p0, v.s);
    vec3 closest = nusselt_cross(v.s, moment);
    float distance = nusselt_length(moment);
    v.gap = distance - v.radius;
    v.sum = distance + v.radius;
    v.l0 = dot(v.start, v.s);
    v.l1 = dot(v.end, v.s);
    v.outside = v.gap >= 0.0 && distance > 0.0;
    float apart = nusselt_max(nusselt_max(v.l0, -v.l1), v.gap);
    v.visible = v.len > 0.0 && v.radius > 0.0 && apart > 2.0 * kNusseltTiny;

    if (v.outside) {
        v.m = nusselt_normalize(closest);
        v.n = nusselt_cross(v.s, v.m);
        v.center = vec2(distance, 0.0);
        v.touching = vec2(sqrt(v.gap / distance) * sqrt(v.sum / distance), v.radius / distance);
        v.cotangent = nusselt_min(sqrt(v.gap) * sqrt(v.sum) / (v.visible ? v.radius : 1.0), kNusseltLargest);
    } else {
        vec3 upwards = nusselt_normalize(nusselt_cross(v.s, nusselt_cross(up, v.s)));
        v.m = upwards == vec3(0.0) ? frame_from_normal(v.s).t : upwards;
        v.n = nusselt_cross(v.s, v.m);
        v.center = vec2(dot(closest, v.m), dot(closest, v.n));
        v.touching = vec2(0.0, 1.0);
        v.cotangent = 0.0;
    }
    return v;
}

/// The half-plane in a direction, or the closest one that touches the cylinder if that one misses it.
/// \param direction unit, in the basis m, n.
/// \param margin    from outside: half-planes this close to one that touches the cylinder count as touching it. The sine of
///                  the angle between both, over that of the angle between the touching one and m.
CylinderSlice cylinder_view_slice(const CylinderView self, vec2 direction, float margin) {
    CylinderSlice c;
    float safe_radius = self.visible ? self.radius : 1.0;
    float offset = det(self.center, direction);
    // From outside, the sines of the angles from both half-planes that touch the cylinder, over the sine of the angle from
    // there to m: a direction whose length is a little wrong scales them, but does not move the point where they vanish.
    float across = self.cotangent * abs(direction.y);
    float from_closer = direction.x - across;
    float from_farther = direction.x + across;
    bool crosses = from_closer > margin;
    c.meets = self.outside ? crosses : abs(offset) < safe_radius;
    c.azimuth = self.outside && !crosses ? vec2(self.touching.x, copysign(self.touching.y, offset)) : direction;
    c.t = c.azimuth.x * self.m + c.azimuth.y * self.n;
    c.offset = nusselt_min(nusselt_max(offset, -safe_radius), safe_radius);
    float along = dot(self.center, c.azimuth); // the middle of the strip
    // Sums of terms that are not negative; products may be too small to be represented.
    float square = crosses ? from_closer * from_farther : 0.0;
    if (!self.outside) {
        float inside_along = along / safe_radius;
        square = nusselt_fma(inside_along, inside_along, (-self.gap / safe_radius) * (self.sum / safe_radius));
    }
    c.half_chord = sqrt(nusselt_max(square, 0.0)) * safe_radius;
    // The product of near and far is that of gap and sum: none of them comes from a difference, nor does the larger
    // one fall below the root.
    float larger = nusselt_max(abs(along) + c.half_chord, sqrt(abs(self.gap)) * sqrt(self.sum));
    float other = abs(self.gap) * (self.sum / (larger > kNusseltTiny ? larger : 1.0));
    c.far = self.outside || along > 0.0 ? larger : other;
    c.near = self.outside ? nusselt_min(other, c.far) : 0.0;
    return c;
}

/// The unit direction of the half-plane that contains a direction, in the basis m, n.
vec2 cylinder_view_azimuth_of(const CylinderView self, vec3 wi) {
    vec2 in_plane = nusselt_normalize(vec3(dot(wi, self.m), dot(wi, self.n), 0.0)).xy;
    return in_plane == vec2(0.0) ? vec2(1.0, 0.0) : in_plane;
}

/// The first point of a ray from the origin that stays in a half-plane and meets the closed cylinder; the closest point
/// of the surface in that half-plane if rounding lets it miss.
/// \param tangent l / rho of the direction.
/// \return (l, rho)
vec2 cylinder_view_first_point(const CylinderView self, const CylinderSlice c, float tangent) {
    float on_side = c.near * tangent;
    if (!(on_side < self.l0 || on_side > self.l1)) return vec2(on_side, c.near);
    float l = on_side < self.l0 ? self.l0 : self.l1;
    float on_cap = l / (tangent == 0.0 ? 1.0 : tangent);
    return vec2(l, nusselt_min(nusselt_max(on_cap, c.near), c.far));
}

/// The intersection of a ray with a light. If the ray does not hit, only `hits` is valid.
struct LightHit {
    bool hits;
    float distance; ///< [m]
    float cosine;   ///< between the ray, backwards, and the normal of the light
};

/// The first point where a ray from the origin meets a closed cylinder from outside, on its lateral surface or on a cap.
/// Rays that start inside hit nothing.
/// \param wi unit direction.
LightHit intersect(const Cylinder cylinder, vec3 wi) {
    float scale = scale_of(cylinder);
    CylinderView view = make_cylinder_view(scaled(cylinder, scale), vec3(0.0));
    CylinderSlice slice = cylinder_view_slice(view, cylinder_view_azimuth_of(view, wi), 0.0);
    float sine = dot(wi, view.s);
    float cosine = nusselt_max(dot(wi, slice.t), 0.0);
    // The ray passes the strip from l = near tan(alpha) to far tan(alpha).
    float enters = slice.near * sine;
    float leaves = slice.far * sine;
    bool reaches = nusselt_max(enters, leaves) >= view.l0 * cosine;
    bool starts = nusselt_min(enters, leaves) <= view.l1 * cosine;
    // Along the axis, the caps must lie ahead.
    bool ahead = nusselt_max(cosine, sine * (view.l0 + view.l1)) > 0.0;
    bool wide = slice.far > 0.0;
    vec2 p = cylinder_view_first_point(view, slice, sine / nusselt_max(cosine, kNusseltTiny));
    bool hits = view.visible && slice.meets && reaches && starts && ahead && wide;
    bool on_side = p.x > view.l0 && p.x < view.l1;
    float facing = cosine * slice.half_chord / (hits ? view.radius : 1.0);
    return LightHit(hits, nusselt_length(vec3(p, 0.0)) * reciprocal_power_of_two(scale),
                    on_side ? facing : abs(sine));
}

#endif
