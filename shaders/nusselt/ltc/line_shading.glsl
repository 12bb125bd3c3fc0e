#ifndef NUSSELT_LTC_LINE_SHADING_GLSL
#define NUSSELT_LTC_LINE_SHADING_GLSL
// Follows include/nusselt/ltc/line_shading.h @ 42ce420c9fb4
/// Analytic, unshadowed shading with linear lights, and tubes and strips approximated by them.
///
/// E. Heitz, S. Hill 2017, Linear-Light Shading with Linearly Transformed Cosines, GPU Zen. Twin of
/// include/nusselt/ltc/line_shading.h, where the deviations stand.
///
/// Integrals of normalised lobes: times the albedo of the lobe and the radiance of the light they are radiance.

#include "../geometry/strip.glsl"
#include "../ltc/light_transform.glsl"

/// Integral of the Lambertian lobe over the part of a linear light above the surface, per radius [1/m].
/// \param light in shading space [m].
float diffuse_integral(const LineSegment light) { return (1.0 / kNusseltPi) * projected_solid_angle(light); }

/// \param part  the part of a light that counts, with coordinates of order one.
/// \param scale by which it is larger than the light.
float lobe_integral_of_part(const LineSegment part, float scale, const Ltc ltc) {
    float ratio = radius_ratio(nusselt_cross(part.p0, part.s), ltc);
    return ratio > 0.0 ? diffuse_integral(to_cosine_space(part, ltc)) / ratio * scale : 0.0;
}

/// Integral of a lobe over a linear light, per radius [1/m]; 0 without length or where its line meets the origin.
/// \param light in shading space with wo in the xz half-plane [m].
float lobe_integral(const LineSegment light, const Ltc ltc) {
    float scale = scale_of(light);
    return lobe_integral_of_part(scaled(light, scale), scale, ltc);
}

/// The same over the part of the light above the surface.
float clipped_lobe_integral(const LineSegment light, const Ltc ltc) {
    float scale = scale_of(light);
    return lobe_integral_of_part(part_above_horizon(scaled(light, scale)), scale, ltc);
}

/// A tube of small radius instead of an infinitely thin one, without its end caps. A lobe has no more to give than 1.
/// \param line_integral of a lobe over the axis of the tube, per radius [1/m].
/// \param radius        [m]
/// \returns integral of the lobe over the tube, in [0, 1]. The error is of the order of radius over distance.
float tube_integral(float line_integral, float radius) { return nusselt_min(line_integral * radius, 1.0); }

/// The same with end caps.
/// \param caps caps_integral() of the lobe.
float tube_integral(float line_integral, float radius, float caps) {
    return nusselt_min(nusselt_fma(line_integral, radius, caps), 1.0);
}

/// The integral over a small disk, over pi.
/// \param p       its centre.
/// \param inward  unit normal of the side that does not shine.
/// \param density of the lobe in the direction of the centre; any value if the centre is the origin.
float small_disk_integral(vec3 p, vec3 inward, float radius, float density) {
    float distance = nusselt_length(p);
    float ratio = radius / distance;
    return distance > 0.0 ? density * nusselt_max(dot(nusselt_normalize(p), inward), 0.0) * ratio * ratio : 0.0;
}

/// \param densities of a lobe in the directions of both ends.
float caps_integral_of_densities(const LineSegment light, float radius, vec2 densities) {
    return kNusseltPi * (small_disk_integral(light.p0, light.s, radius, densities.x) +
                         small_disk_integral(end_of(light), -light.s, radius, densities.y));
}

/// The end caps of a tube as small disks, for tube_integral(). Heitz and Hill advise against it by default: bright
/// spots show where a lobe is narrower than the tube.
/// \param light  the axis, in shading space [m].
/// \param radius [m]
float caps_integral(const LineSegment light, float radius, const Ltc ltc) {
    vec3 w0 = nusselt_normalize(light.p0);
    vec3 w1 = nusselt_normalize(end_of(light));
    return caps_integral_of_densities(light, radius, vec2(ltc_density(ltc, w0), ltc_density(ltc, w1)));
}

/// The same for ends above the surface only.
float clipped_caps_integral(const LineSegment light, float radius, const Ltc ltc) {
    vec3 w0 = nusselt_normalize(light.p0);
    vec3 w1 = nusselt_normalize(end_of(light));
    vec2 densities = vec2(w0.z > 0.0 ? ltc_density(ltc, w0) : 0.0, w1.z > 0.0 ? ltc_density(ltc, w1) : 0.0);
    return caps_integral_of_densities(light, radius, densities);
}

/// The same for the Lambertian lobe.
float diffuse_caps_integral(const LineSegment light, float radius) {
    vec2 heights = vec2(nusselt_normalize(light.p0).z, nusselt_normalize(end_of(light)).z);
    return caps_integral_of_densities(light, radius, (1.0 / kNusseltPi) * max(heights, vec2(0.0)));
}

/// A narrow strip instead of a thin tube: it looks the thinner the more it turns its edge to the point.
/// \param light         the middle line, in shading space [m].
/// \param normal        of the strip, unit, perpendicular to the line; both sides shine.
/// \param width         of the strip [m].
/// \param line_integral of a lobe over the line, per radius [1/m].
/// \returns integral of the lobe over the strip, in [0, 1]. The error is of the order of width over distance.
float strip_integral(const LineSegment light, vec3 normal, float width, float line_integral) {
    return tube_integral(line_integral * strip_facing(light, normal), 0.5 * width);
}

#endif
