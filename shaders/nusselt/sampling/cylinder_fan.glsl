#ifndef NUSSELT_SAMPLING_CYLINDER_FAN_GLSL
#define NUSSELT_SAMPLING_CYLINDER_FAN_GLSL
// Follows include/nusselt/sampling/cylinder_fan.h @ 1f0dfae1eae7
/// Sampling of closed cylinders without rejection: first a half-plane of the fan around the direction of the axis, then
/// a direction in it. What the techniques for cylinders share. Twin of include/nusselt/sampling/cylinder_fan.h;
/// docs/techniques/cylinder.md has the derivation.
///
/// A half-plane cuts a rectangle out of the cylinder, caps included, which spans one interval of directions. Their
/// integral is known in closed form and is sampled as that of a line; the azimuth of the half-plane follows an
/// interpolant of these integrals.

#include "../geometry/cylinder.glsl"
#include "../ltc/ltc.glsl"
#include "../sampling/cosine_arc.glsl"
#include "../sampling/piecewise_linear.glsl"

/// Share of the largest integral that is added at all nodes: no visible half-plane has a density near zero, whatever
/// happens between the nodes.
const float kNusseltLeastShare = 0.0078125; // 1 / 128

/// Directions closer to the axis than its reciprocal cannot be distinguished from the axis.
const float kNusseltSteepest = 68719476736.0; // 2^36

/// Importance of directions: all alike, or the cosine, 0 below the horizon. Functions take one of these constants, which
/// compilers propagate.
const int kNusseltUniformImportance = 0;
const int kNusseltCosineImportance = 1;

LineExtent importance_extent(int importance, const CenteredLine line) {
    if (importance == kNusseltUniformImportance) return make_line_extent(line);
    return make_line_extent(clip_to_horizon(line));
}

/// Twice the integral over the solid angle, per azimuth.
float importance_integral(int importance, const LineExtent e) {
    return importance == kNusseltUniformImportance ? 2.0 * line_extent_sine_extent(e).difference : cosine_integral(e);
}

LinePoint importance_point(int importance, const LineExtent e, float u) {
    if (importance == kNusseltUniformImportance)
        return line_map_point_at(make_line_map(e), e.line.sign_of_s > 0.0 ? u : 1.0 - u);
    return cosine_arc_point(make_cosine_arc(e), u);
}

float importance_invert(int importance, const LineExtent e, vec3 wi) {
    if (importance == kNusseltUniformImportance) {
        float share = line_map_share_in(make_line_map(e), wi);
        return below_one(e.line.sign_of_s > 0.0 ? share : 1.0 - share);
    }
    return cosine_arc_invert(make_cosine_arc(e), wi);
}

/// Shading space where a fan asks for the cosine space of a lobe: the lobe is the clamped cosine.
Ltc shading_space() { return Ltc(1.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0); }

/// The normal of the horizon in shading space: directions with a positive product have importance.
vec3 ltc_horizon_normal(const Ltc self) {
    return vec3(ltc_to_cosine(self, vec3(1.0, 0.0, 0.0)).z, ltc_to_cosine(self, vec3(0.0, 1.0, 0.0)).z,
                ltc_to_cosine(self, vec3(0.0, 0.0, 1.0)).z);
}

/// A cylinder and its image in the space of the importance. The image of the axis and of the basis of the view:
/// image(view.m) = m_along_m m + m_along_s s, and so on.
struct CylinderImage {
    CylinderView view;
    vec3 s, m, n;  ///< right-handed, orthonormal
    float stretch; ///< of the axis
    float m_along_m, n_along_m, n_along_n, m_along_s, n_along_s;
    float height_of_m, height_of_n, start_height, end_height;
};

CylinderImage make_cylinder_image(const Cylinder cylinder, const Ltc space) {
    CylinderImage self;
    self.view = make_cylinder_view(cylinder, ltc_horizon_normal(space));
    vec3 s = ltc_to_cosine(space, self.view.s);
    vec3 m = ltc_to_cosine(space, self.view.m);
    vec3 n = ltc_to_cosine(space, self.view.n);
    // The image of the plane across n contains those of s and m. Products, not differences: images may be flat.
    vec3 across = ltc_normal_to_cosine(space, self.view.n);
    self.stretch = nusselt_length(s);
    self.s = nusselt_normalize(s);
    self.n = nusselt_normalize(across);
    self.m = nusselt_cross(self.n, self.s);
    float safe_stretch = self.stretch > 0.0 ? self.stretch : 1.0;
    self.m_along_m = space.m11 * nusselt_length(across) / safe_stretch;
    self.n_along_n = space.minor / (self.m_along_m > 0.0 ? self.m_along_m : 1.0) * space.m11 / safe_stretch;
    self.n_along_m = dot(n, self.m);
    self.m_along_s = dot(m, self.s);
    self.n_along_s = dot(n, self.s);
    self.height_of_m = m.z;
    self.height_of_n = n.z;
    self.start_height = ltc_to_cosine(space, self.view.start).z;
    self.end_height = ltc_to_cosine(space, self.view.end).z;
    return self;
}

/// The image of a half-plane direction, in the basis m, n.
vec2 cylinder_image_of(const CylinderImage self, vec2 azimuth) {
    return vec2(nusselt_fma(azimuth.x, self.m_along_m, azimuth.y * self.n_along_m), azimuth.y * self.n_along_n);
}

/// Azimuth of the image, in [-pi, pi].
/// \param azimuth of any length.
float cylinder_image_angle_of(const CylinderImage self, vec2 azimuth) {
    vec2 image = cylinder_image_of(self, azimuth);
    return copysign(atan2_positive(abs(image.y), image.x), image.y);
}

vec2 cylinder_image_azimuth_at(const CylinderImage self, float angle) {
    SinCos turn = sincos_half_turn(nusselt_min(abs(angle), kNusseltPi));
    float sine = copysign(abs(turn.sine), angle);
    float x = difference_of_products(self.n_along_n, turn.cosine, self.n_along_m, sine);
    return nusselt_normalize(vec3(x, self.m_along_m * sine, 0.0)).xy;
}

/// Image height of the unit vector across a half-plane, towards larger azimuths.
float cylinder_image_height_to_the_left_of(const CylinderImage self, vec2 azimuth) {
    return nusselt_fma(azimuth.x, self.height_of_n, -azimuth.y * self.height_of_m);
}

/// Azimuths around the image of the axis, from m to n.
struct AzimuthRange {
    float low, extent;
};

/// Widens a range from low to high by the points where a rim crosses the horizon, if it does.
/// \param height of the middle of the rim.
/// \param rise   of the rim above its middle.
/// \param up     where it is highest.
void include_rim(const CylinderImage self, float height, float rise, vec2 up, inout float low, inout float high) {
    if (!(abs(height) < rise)) return;
    float upwards = -height / rise;
    float sideways = sqrt(nusselt_max((1.0 - upwards) * (1.0 + upwards), 0.0));
    vec2 middle = self.view.center + (upwards * self.view.radius) * up;
    vec2 to_side = (sideways * self.view.radius) * vec2(-up.y, up.x);
    float angle0 = cylinder_image_angle_of(self, middle - to_side);
    float angle1 = cylinder_image_angle_of(self, middle + to_side);
    low = nusselt_min(low, nusselt_min(angle0, angle1));
    high = nusselt_max(high, nusselt_max(angle0, angle1));
}

/// The azimuths of the part of the cylinder that has importance. They are bounded by half-planes that touch the
/// cylinder, if these reach above the horizon, or else by points of the rims in the horizon.
AzimuthRange cylinder_image_range(const CylinderImage self, int importance) {
    CylinderView view = self.view;
    vec2 left = view.touching;
    vec2 right = vec2(left.x, -left.y);
    float leftmost = view.outside ? cylinder_image_angle_of(self, left) : kNusseltPi;
    float rightmost = view.outside ? cylinder_image_angle_of(self, right) : -kNusseltPi;
    if (importance == kNusseltUniformImportance)
        return AzimuthRange(rightmost, nusselt_max(leftmost - rightmost, 0.0));

    float axis_height = nusselt_max(self.start_height, self.end_height);
    float left_height = axis_height + view.radius * cylinder_image_height_to_the_left_of(self, left);
    float right_height = axis_height - view.radius * cylinder_image_height_to_the_left_of(self, right);
    // From inside, the fan covers everything around the axis if the axis rises.
    float axis_slope = view.l0 > 0.0 ? self.s.z : -self.s.z;
    bool surrounded = !view.outside && axis_slope > kNusseltTiny;
    vec2 up = nusselt_normalize(vec3(self.height_of_m, self.height_of_n, 0.0)).xy;
    float rise = view.radius * nusselt_fma(up.x, self.height_of_m, up.y * self.height_of_n);
    // A rim wholly above the horizon: the lines that touch it rise too, despite rounding.
    bool has_rim_above = axis_height >= rise;
    bool sees_left = surrounded || has_rim_above || (view.outside && left_height > 0.0);
    bool sees_right = surrounded || has_rim_above || (view.outside && right_height > 0.0);
    float low = leftmost;
    float high = rightmost;
    include_rim(self, self.start_height, rise, up, low, high);
    include_rim(self, self.end_height, rise, up, low, high);
    low = sees_right ? rightmost : nusselt_max(low, rightmost);
    high = sees_left ? leftmost : nusselt_min(high, leftmost);
    return AzimuthRange(low, nusselt_max(high - low, 0.0));
}

/// A half-plane of the fan and its image.
struct CylinderHalfPlane {
    CylinderSlice slice;
    float widening, shear; ///< image of slice.t across and along the axis
    LineExtent extent;     ///< of the image, on the line at distance one
    float integral;        ///< of the importance
};

/// Tangent of the direction to a corner (l, rho) of the rectangle in the image of its half-plane.
float cylinder_image_tangent(const CylinderImage self, float l, float rho, float widening, float shear) {
    // rho may be 0.
    float slope = abs(l) < rho / kNusseltTiny ? l / rho : copysign(1.0 / kNusseltTiny, l);
    float tangent = nusselt_fma(self.stretch, slope, shear) / widening;
    return nusselt_min(nusselt_max(tangent, -kNusseltSteepest), kNusseltSteepest);
}

/// A corner of the rectangle, on the line at distance one.
/// \param t        direction of the image of the half-plane.
/// \param height   of the corner of the cylinder.
/// \param distance of the image of that corner from the axis; may be 0 where the tangent is steepest.
vec3 cylinder_image_corner(const CylinderImage self, vec3 t, float tangent, float height, float distance) {
    vec3 p = tangent * self.s + t;
    if (abs(tangent) < kNusseltSteepest) p.z = height / distance;
    return p;
}

CylinderHalfPlane cylinder_half_plane(const CylinderImage self, int importance, vec2 direction) {
    CylinderView view = self.view;
    CylinderHalfPlane h;
    // Integrals start like a square root where half-planes touch the cylinder, which would magnify rounding.
    // Twice the margin of C++: devices need not round correctly.
    h.slice = cylinder_view_slice(view, direction, 8.0 * kNusseltEpsilon);
    vec2 azimuth = h.slice.azimuth;
    vec2 image = cylinder_image_of(self, azimuth);
    h.widening = sqrt(dot(image, image));
    h.shear = nusselt_fma(azimuth.x, self.m_along_s, azimuth.y * self.n_along_s);
    vec3 t = (1.0 / h.widening) * (image.x * self.m + image.y * self.n);

    // Corners of the rectangle that bound the interval of directions.
    bool starts_far = view.l0 > 0.0;
    bool ends_far = view.l1 < 0.0;
    float rho0 = starts_far ? h.slice.far : h.slice.near;
    float rho1 = ends_far ? h.slice.far : h.slice.near;
    float tangent0 = cylinder_image_tangent(self, view.l0, rho0, h.widening, h.shear);
    float tangent1 = cylinder_image_tangent(self, view.l1, rho1, h.widening, h.shear);
    float len = tangent1 - tangent0;
    if (nusselt_max(abs(tangent0), abs(tangent1)) < kNusseltSteepest) {
        // The difference of the tangents as a sum of areas that are not negative.
        float beyond = nusselt_max(nusselt_max(view.l0, -view.l1), 0.0);
        float rho = beyond > 0.0 ? h.slice.far : h.slice.near;
        float area = nusselt_fma(view.len, rho, beyond * (h.slice.far - h.slice.near));
        len = area / rho0 / rho1 * (self.stretch / h.widening);
    }

    float height_of_t = nusselt_fma(azimuth.x, self.height_of_m, azimuth.y * self.height_of_n);
    float sideways = h.slice.offset * cylinder_image_height_to_the_left_of(self, azimuth);
    float across = h.slice.half_chord * height_of_t;
    float height0 = self.start_height + (sideways + (starts_far ? across : -across));
    float height1 = self.end_height + (sideways + (ends_far ? across : -across));
    vec3 p0 = cylinder_image_corner(self, t, tangent0, height0, rho0 * h.widening);
    vec3 p1 = cylinder_image_corner(self, t, tangent1, height1, rho1 * h.widening);
    h.extent = importance_extent(importance, line_between(self.s, p0, p1, t, 1.0, tangent0, tangent1, len));
    float integral = importance_integral(importance, h.extent);
    h.integral = line_extent_visible(h.extent) && is_finite(integral) ? integral : 0.0;
    return h;
}

struct CylinderFan {
    int importance;
    CylinderImage image;
    AzimuthRange range;
    PiecewiseLinear warp;
    float integral; ///< estimate for the importance over the cylinder, by the interpolant; 0 if nothing is visible
    float inverse_normalization; ///< 0 if nothing is visible
};

/// \param importance of directions, one of the constants above.
/// \param cylinder   in shading space, with coordinates of order one.
/// \param space      where directions have the importance: shading_space(), or the cosine space of a lobe.
CylinderFan make_cylinder_fan(int importance, const Cylinder cylinder, const Ltc space) {
    CylinderFan self;
    self.importance = importance;
    self.image = make_cylinder_image(cylinder, space);
    self.range = cylinder_image_range(self.image, importance);
    float value[kNusseltNodes];
    float largest = 0.0;
    NUSSELT_UNROLL for (int i = 0; i < kNusseltNodes; ++i) {
        float angle = nusselt_fma(piecewise_linear_node(i), self.range.extent, self.range.low);
        value[i] = cylinder_half_plane(self.image, importance, cylinder_image_azimuth_at(self.image, angle)).integral;
        largest = nusselt_max(value[i], largest);
    }
    float integral = 0.5 * self.range.extent * piecewise_linear_integral(make_piecewise_linear(value));
    NUSSELT_UNROLL for (int i = 0; i < kNusseltNodes; ++i) {
        value[i] = nusselt_fma(largest, kNusseltLeastShare, value[i]);
    }
    self.warp = make_piecewise_linear(value);
    float normalization = piecewise_linear_integral(self.warp) * self.range.extent;
    // Callers divide the integral by pi, and denormal numbers may be flushed.
    bool fits = is_finite(normalization) && normalization > kNusseltSmallestNormal;
    bool lit = self.image.view.visible && integral > 4.0 * kNusseltSmallestNormal && fits;
    self.integral = lit ? integral : 0.0;
    self.inverse_normalization = lit ? 1.0 / normalization : 0.0;
    return self;
}

/// Position in the range of azimuths, in [0, 1].
float cylinder_fan_share_of(const CylinderFan self, vec2 azimuth) {
    float from_low = cylinder_image_angle_of(self.image, azimuth) - self.range.low;
    float safe_extent = self.range.extent > 0.0 ? self.range.extent : 1.0;
    return nusselt_min(nusselt_max(from_low / safe_extent, 0.0), 1.0);
}

/// The half-plane for a random number in [0, 1).
CylinderHalfPlane cylinder_fan_half_plane(const CylinderFan self, float u) {
    float angle = nusselt_fma(piecewise_linear_invert(self.warp, u), self.range.extent, self.range.low);
    return cylinder_half_plane(self.image, self.importance, cylinder_image_azimuth_at(self.image, angle));
}

/// The point of the cylinder in a half-plane for a random number in [0, 1), which rises along the axis.
vec3 cylinder_fan_point_in(const CylinderFan self, const CylinderHalfPlane h, float u) {
    LinePoint point = importance_point(self.importance, h.extent, u);
    float sine = h.extent.line.sign_of_s * line_map_sine_at(make_line_map(h.extent), point.share);
    float mapped = sine / nusselt_max(point.inverse_distance, 1.0 / kNusseltSteepest);
    // In a half-plane without importance the map may not exist. Any point will do, its density is 0.
    float steepness = h.integral > 0.0 ? mapped : 0.0;
    float tangent = (h.widening * steepness - h.shear) / self.image.stretch;
    vec2 p = cylinder_view_first_point(self.image.view, h.slice, tangent);
    return p.x * self.image.view.s + p.y * h.slice.t;
}

/// The point of the cylinder for random numbers in [0, 1)^2: u.x chooses the half-plane, u.y the direction in it, rising
/// along the axis. Without meaning if the integral is 0.
vec3 cylinder_fan_point(const CylinderFan self, vec2 u) {
    return cylinder_fan_point_in(self, cylinder_fan_half_plane(self, u.x), u.y);
}

/// Density with respect to solid angle in the space of the importance, over the importance [1/sr].
/// \param wi unit direction in shading space that hits the cylinder.
float cylinder_fan_density_per_importance(const CylinderFan self, vec3 wi) {
    vec2 azimuth = cylinder_view_azimuth_of(self.image.view, wi);
    CylinderHalfPlane h = cylinder_half_plane(self.image, self.importance, azimuth);
    if (!(h.integral > 0.0)) return 0.0;
    float share = cylinder_fan_share_of(self, h.slice.azimuth);
    float density = piecewise_linear_value(self.warp, share) * self.inverse_normalization;
    float ratio = 2.0 * density / h.integral;
    return is_finite(ratio) ? ratio : 0.0;
}

/// The random numbers for which cylinder_fan_point() lies in direction wi.
/// \param image_of_wi in the space of the importance, of any length.
vec2 cylinder_fan_invert(const CylinderFan self, vec3 wi, vec3 image_of_wi) {
    vec2 azimuth = cylinder_view_azimuth_of(self.image.view, wi);
    CylinderHalfPlane h = cylinder_half_plane(self.image, self.importance, azimuth);
    float below = piecewise_linear_below(self.warp, cylinder_fan_share_of(self, h.slice.azimuth));
    float normalization = self.integral > 0.0 ? piecewise_linear_integral(self.warp) : 1.0;
    return vec2(below_one(below / normalization),
                importance_invert(self.importance, h.extent, nusselt_normalize(image_of_wi)));
}

#endif
