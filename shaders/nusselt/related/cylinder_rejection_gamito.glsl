#ifndef NUSSELT_RELATED_CYLINDER_REJECTION_GAMITO_GLSL
#define NUSSELT_RELATED_CYLINDER_REJECTION_GAMITO_GLSL
// Follows include/nusselt/related/cylinder_rejection_gamito.h @ e84609d96010
/// A published method, to compare with: sampling of a rectangle around the silhouette of a cylinder.
///
/// M. N. Gamito 2016, Solid Angle Sampling of Disk and Cylinder Lights, CGF 35(4), doi:10.1111/cgf.12946. Use
/// cylinder_solid_angle.glsl instead: it misses nothing. Twin of include/nusselt/related/cylinder_rejection_gamito.h,
/// where deviations and failures stand.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure.
/// Space: any frame with the shading point as origin; nothing is clipped.
/// Edge cases: no length or radius, or origin inside: pdf = 0, measure 0.

#include "../core/light_sample.glsl"
#include "../geometry/cylinder.glsl"
#include "../related/rectangle_polygon.glsl"
#include "../sampling/rectangle_solid_angle.glsl"

/// A closed cylinder, prepared for rays that start at the origin outside of it.
struct GamitoRayTarget {
    vec3 s, m, n; ///< orthonormal; s along the axis
    vec2 center;  ///< where the infinite axis passes, in the basis m, n
    float squared_radius;
    float power;  ///< squared distance of the infinite axis minus squared radius: negative within
    float l0, l1; ///< of the caps along s
};

GamitoRayTarget make_gamito_ray_target(const CylinderView view) {
    return GamitoRayTarget(view.s, view.m, view.n, view.center, view.radius * view.radius, view.gap * view.sum, view.l0,
                           view.l1);
}

struct GamitoHit {
    bool hits;
    float distance; ///< of the first point; 0 without a hit
};

/// \param wi unit direction.
GamitoHit gamito_ray_target_intersect(const GamitoRayTarget self, vec3 wi) {
    // Intersect the ray with the infinite cylinder. A ray that misses only by rounding touches it.
    vec2 across = vec2(dot(wi, self.m), dot(wi, self.n));
    float squares = dot(across, across);
    float middle = dot(across, self.center);
    float offset = det(self.center, across);
    float root = sqrt(nusselt_max(nusselt_fma(squares, self.squared_radius, -offset * offset), 0.0));
    // The product of both roots is power / squares: neither comes from a difference.
    float larger = nusselt_max(abs(middle) + root, kNusseltTiny);
    float smaller_root = abs(self.power) / larger;
    float larger_root = larger / nusselt_max(squares, kNusseltTiny);
    bool outside = self.power >= 0.0;
    float near = outside ? smaller_root : 0.0;
    float far = middle > 0.0 ? larger_root : outside ? 0.0 : smaller_root;

    // Intersect it with the slab between the caps.
    float along = dot(wi, self.s);
    float inverse = 1.0 / copysign(nusselt_max(abs(along), kNusseltTiny), along);
    float to_start = inverse * self.l0;
    float to_end = inverse * self.l1;
    float enters = nusselt_max(near, nusselt_min(to_start, to_end));
    float leaves = nusselt_min(far, nusselt_max(to_start, to_end));
    bool hits = enters <= leaves && enters > 0.0;
    return GamitoHit(hits, hits ? enters : 0.0);
}

/// \returns a polygon of no size if nothing is visible.
ConvexPolygon gamito_rectangle_around(const CylinderView v) {
    vec3 corner = vec3(0.0);
    vec3 first = vec3(0.0);
    vec3 second = vec3(0.0);
    vec3 normal = vec3(0.0);
    if (v.visible && v.outside) {
        // Across the direction to the axis, where the tangents from the origin touch the cylinder.
        float distance = v.center.x;
        float ratio = v.radius / distance;
        float depth = v.gap * (v.sum / distance);
        float half_width = ratio * sqrt(nusselt_max(v.gap, 0.0)) * sqrt(v.sum);
        float low = v.l0 * (v.l0 < 0.0 ? 1.0 + ratio : 1.0 - ratio);
        float high = v.l1 * (v.l1 > 0.0 ? 1.0 + ratio : 1.0 - ratio);
        corner = depth * v.m + low * v.s - half_width * v.n;
        first = (high - low) * v.s;
        second = (2.0 * half_width) * v.n;
        normal = -v.m;
    } else if (v.visible) {
        // The square around the nearer cap.
        vec3 cap = v.l0 > 0.0 ? v.start : v.end;
        corner = cap - v.radius * v.m - v.radius * v.n;
        first = (2.0 * v.radius) * v.m;
        second = (2.0 * v.radius) * v.n;
        normal = v.s;
    }
    return rectangle_polygon(corner, first, second, normal);
}

struct CylinderRejectionGamito {
    RectangleSolidAngle rectangle; ///< of the cylinder with an extent of order one
    GamitoRayTarget target;
    float inverse_scale;
};

/// \param light relative to the shading point [m].
CylinderRejectionGamito cylinder_rejection_gamito_prepare(const Cylinder light) {
    float scale = scale_of(light);
    CylinderView view = make_cylinder_view(scaled(light, scale), vec3(0.0));
    return CylinderRejectionGamito(rectangle_solid_angle_prepare(gamito_rectangle_around(view)),
                                   make_gamito_ray_target(view), reciprocal_power_of_two(scale));
}

/// Solid angle of the rectangle [sr], which is larger than that of the light.
float cylinder_rejection_gamito_measure(const CylinderRejectionGamito self) {
    return rectangle_solid_angle_measure(self.rectangle);
}

/// The density of directions in the rectangle, whether they hit the cylinder or not.
float cylinder_rejection_gamito_pdf(const CylinderRejectionGamito self, vec3 wi) {
    return rectangle_solid_angle_pdf(self.rectangle, wi);
}

/// A sample of the rectangle as one of the cylinder.
LightSample gamito_sample(const LightSample s, const GamitoRayTarget target, float inverse_scale) {
    GamitoHit hit = gamito_ray_target_intersect(target, s.wi);
    return LightSample(s.wi, hit.hits ? s.pdf : 0.0, (inverse_scale * hit.distance) * s.wi);
}

/// \param u in [0, 1)^2, of the rectangle.
/// \return pdf = 0 where the direction misses the cylinder: an estimate counts it as 0.
LightSample cylinder_rejection_gamito_sample(const CylinderRejectionGamito self, vec2 u) {
    return gamito_sample(rectangle_solid_angle_sample(self.rectangle, u), self.target, self.inverse_scale);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 cylinder_rejection_gamito_invert(const CylinderRejectionGamito self, vec3 wi) {
    return rectangle_solid_angle_invert(self.rectangle, wi);
}

#endif
