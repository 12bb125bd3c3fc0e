#ifndef NUSSELT_CONES_ELLIPTIC_CONE_GLSL
#define NUSSELT_CONES_ELLIPTIC_CONE_GLSL
// Follows include/nusselt/cones/elliptic_cone.h @ 43bf7dcc8ed2
/// Elliptic cones: what a point sees of a disk, an ellipse, a sphere or an ellipsoid. Twin of
/// include/nusselt/cones/elliptic_cone.h, for ellipses: spheres and disks are ellipsoids and ellipses here.

#include "../core/frame.glsl"

/// sqrt(x^2 + y^2) without underflow of the squares, for numbers of order one and less.
float hypotenuse(float x, float y) {
    float larger = nusselt_max(abs(x), abs(y));
    float ratio = nusselt_min(abs(x), abs(y)) / (larger > 0.0 ? larger : 1.0);
    return larger * sqrt(nusselt_fma(ratio, ratio, 1.0));
}

/// numerator / denominator, or 0 unless the denominator is positive.
float over_positive(float numerator, float denominator) {
    return denominator > 0.0 ? numerator / denominator : 0.0;
}

/// The cone of directions c e3 + a s e1 + b t e2 with s^2 + t^2 <= 1. a / c and b / c are the tangents of its
/// half-angles; c = 0 is a half-space. The points (s, t) are those of the disk of the cone.
struct EllipticCone {
    vec3 e1, e2, e3;       ///< right-handed, orthonormal; e3 is the axis
    float a, b, c;         ///< not negative, the largest is 1; a = 0 or b = 0: the light is seen edge-on
    vec3 row0, row1, row2; ///< of the Lorentz matrix that leads to the disk of the light
    bool is_visible;       ///< false for a light without extent, and on its rim
};

/// Angles up to this one may be a matter of rounding.
const float kNusseltConeRounding = 8.0 * kNusseltEpsilon;

/// The heights of the axes of a cone above the horizon z = 0. Those of e1 and e2 are 0 if the cone is a half-space up to
/// rounding, and rounding may cause them: otherwise, the horizon would cut half-spaces whose rim lies in it.
vec3 heights_of_axes(const EllipticCone cone) {
    vec3 height = vec3(cone.e1.z, cone.e2.z, cone.e3.z);
    bool is_half_space = cone.c < kNusseltConeRounding;
    if (is_half_space && abs(height.x) <= kNusseltConeRounding) height.x = 0.0;
    if (is_half_space && abs(height.y) <= kNusseltConeRounding) height.y = 0.0;
    return height;
}

/// The point (sigma, tau) of the unit disk from which the light was made.
/// \param disk a point of the disk of the cone.
vec2 elliptic_cone_to_light(const EllipticCone self, vec2 disk) {
    vec3 at = vec3(disk, 1.0);
    float z = dot(self.row2, at);
    float inverse = 1.0 / (z > 0.0 ? z : 1.0);
    vec2 p = vec2(dot(self.row0, at), dot(self.row1, at)) * inverse;
    float squared = dot(p, p);
    return (squared > 1.0 ? 1.0 / sqrt(squared) : 1.0) * p;
}

/// The columns of a cone and the columns of its Lorentz matrix while they become orthogonal.
struct ConeColumns {
    vec3 u, v, c;
    vec3 lu, lv, lc;
};

/// Rotates u and v by less than 45 degrees, so that they become perpendicular. Those of a circle stay as they are, for
/// rounding would turn them anyhow, and samples of neighbouring points would have nothing in common.
void cone_columns_turn(inout ConeColumns self) {
    float both = dot(self.u, self.v);
    float difference = dot(self.u - self.v, self.u + self.v);
    float denominator = abs(difference) + hypotenuse(difference, both + both);
    float rounding = (4.0 * kNusseltEpsilon) * (dot(self.u, self.u) + dot(self.v, self.v));
    float ratio = denominator > rounding ? over_positive(abs(both + both), denominator) : 0.0;
    float tangent = copysign(ratio, both * difference);
    float cosine = 1.0 / sqrt(nusselt_fma(tangent, tangent, 1.0));
    float sine = tangent * cosine;
    vec3 u = cosine * self.u + sine * self.v;
    self.v = cosine * self.v - sine * self.u;
    self.u = u;
    vec3 lu = cosine * self.lu + sine * self.lv;
    self.lv = cosine * self.lv - sine * self.lu;
    self.lu = lu;
}

/// Makes a column x perpendicular to c by a Lorentz boost. The root is that of (x^2 + c^2)^2 - 4 (x c)^2: nothing
/// cancels.
void boost_columns(inout vec3 x, inout vec3 c, inout vec3 lx, inout vec3 lc) {
    float both = dot(x, c);
    vec3 less = c - x;
    vec3 more = c + x;
    float root = sqrt(dot(less, less)) * sqrt(dot(more, more));
    float h = -copysign(over_positive(abs(both + both), dot(x, x) + dot(c, c) + root), both);
    // The square of 1 - h^2 is a number only if the point is not on the rim of the light.
    float g = 1.0 / sqrt(nusselt_max((1.0 - h) * (1.0 + h), kNusseltEpsilon / 64.0));
    vec3 boosted = g * (x + h * c);
    c = g * (c + h * x);
    x = boosted;
    vec3 l = g * (lx + h * lc);
    lc = g * (lc + h * lx);
    lx = l;
}

/// Orthonormal axes of columns that are almost orthogonal, the longer ones first.
EllipticCone cone_of_columns(const ConeColumns k, vec3 front) {
    float a = nusselt_length(k.u);
    float b = nusselt_length(k.v);
    float c = nusselt_length(k.c);
    bool c_first = c >= a && c >= b;
    bool u_first = !c_first && a >= b;

    // In cyclic order, starting with the longest: the first, and the longer one of the other two.
    vec3 first = nusselt_normalize(c_first ? k.c : u_first ? k.u : k.v);
    vec3 second = c_first ? k.u : u_first ? k.v : k.c;
    vec3 third = c_first ? k.v : u_first ? k.c : k.u;
    bool in_order = (c_first ? a : u_first ? b : c) >= (c_first ? b : u_first ? c : a);
    // Their cross product is perpendicular to the first even if the columns are almost parallel.
    vec3 across = nusselt_normalize(nusselt_cross(first, nusselt_normalize(in_order ? second : third)));
    vec3 normal = dot(across, across) == 0.0 ? frame_from_normal(first).b : across;
    vec3 along = nusselt_cross(normal, first);
    vec3 axis2 = in_order ? along : -normal;
    vec3 axis3 = in_order ? normal : along;

    // The axes are right-handed; the columns need not be. A half-space has no centre: the side of the light decides.
    EllipticCone cone;
    vec3 e3 = c_first ? first : u_first ? axis3 : axis2;
    float down = dot(e3, c > 0.0 ? k.c : front) < 0.0 ? -1.0 : 1.0;
    cone.e1 = down * (c_first ? axis2 : u_first ? first : axis3);
    cone.e2 = c_first ? axis3 : u_first ? axis2 : first;
    cone.e3 = down * e3;
    vec3 lu = (dot(cone.e1, k.u) < 0.0 ? -1.0 : 1.0) * k.lu;
    vec3 lv = (dot(cone.e2, k.v) < 0.0 ? -1.0 : 1.0) * k.lv;
    cone.row0 = vec3(lu.x, lv.x, k.lc.x);
    cone.row1 = vec3(lu.y, lv.y, k.lc.y);
    cone.row2 = vec3(lu.z, lv.z, k.lc.z);

    float largest = nusselt_max(nusselt_max(a, b), c);
    cone.is_visible = largest > 0.0 && is_finite(largest);
    float inverse = 1.0 / (cone.is_visible ? largest : 1.0);
    // Denormal numbers have too few digits.
    cone.a = without_tiny(inverse * a);
    cone.b = without_tiny(inverse * b);
    cone.c = without_tiny(inverse * c);
    return cone;
}

/// The cone of an ellipse. Four sweeps of the Jacobi method leave errors of a few roundings; ellipses closer than
/// 1e-3 of their size have errors of the rounding over the distance relative to the size.
/// \param u, v   conjugate semi-diameters of an ellipse.
/// \param centre relative to the origin; all with coordinates of order one.
/// \param front  a vector to the side of the cone where the light is, should the origin lie in the plane of the
///               ellipse.
EllipticCone cone_of_ellipse(vec3 u, vec3 v, vec3 centre, vec3 front) {
    ConeColumns k = ConeColumns(u, v, centre, vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    NUSSELT_LOOP for (int i = 0; i < 4; ++i) {
        cone_columns_turn(k);
        boost_columns(k.u, k.c, k.lu, k.lc);
        boost_columns(k.v, k.c, k.lv, k.lc);
    }
    return cone_of_columns(k, front);
}

#endif
