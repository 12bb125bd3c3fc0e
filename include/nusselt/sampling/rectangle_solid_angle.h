#pragma once
/// Uniform sampling of the solid angle of a rectangle, without a seam: a triangulation would map random numbers to the
/// two halves of the light in different ways, which spoils their stratification.
///
/// C. Ureña, M. Fajardo, A. King 2013, An Area-Preserving Parametrization for Spherical Rectangles, CGF 32(4),
/// doi:10.1111/cgf.12151: x so that the solid angle to the left of it is u.x of the whole, y so that the solid angle
/// within a strip of no width is u.y of the whole. Deviations: the published formulas for the solid angle (the sum of
/// the inner angles less two pi), x and y subtract almost equal numbers for small lights and for grazing ones. Here all
/// angles are sums of solid angles of strips, which are positive; docs/techniques/polygon_solid_angle.md derives them.

#include <limits>

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/core/trig.h>
#include <nusselt/geometry/polygon_measures.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double, one light and shading point per lane.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure().
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no area, or origin in the plane of the rectangle: pdf = 0, measure 0.
///             An origin closer to the rectangle than 2^-60 (float) or 2^-480 (double) of its size counts as being at
///             that distance.
template <class Real>
class RectangleSolidAngle {
public:
    /// \param light relative to the shading point, either winding [m]. A rectangle up to rounding; other polygons give
    ///              samples that miss the light.
    NUSSELT_HD explicit RectangleSolidAngle(const ConvexPolygon<Real, 4>& light) noexcept
        : RectangleSolidAngle(to_unit_extent(light)) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit RectangleSolidAngle(const RectangleSolidAngle<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x moves along the first edge of the light, u.y across it. Continuous in both.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        // Of the strip between the lines of the upper and the lower edge, p is the solid angle to the left of x and q
        // that to the right of it. Their halves sum up to the angle between the planes of the lines.
        const Real p = Real(0.5) * fma(u.x, total_, left_);
        const Real q = Real(0.5) * fma(Real(1) - u.x, total_, right_);
        // With these x = distance sin(p - q) / (2 sqrt(sin p sin q sin(p + upper) sin(q + upper))). Each sine is that of
        // the smaller one of two angles that sum up to pi: there it keeps its digits.
        const Real outside = upper_ + lower_;
        const Real sines_pq = sine(p, outside + q) * sine(q, outside + p);
        const Real sines_edges = sine(upper_ + p, lower_ + q) * sine(upper_ + q, lower_ + p);
        const Real denominator = Real(2) * sqrt(sines_pq) * sqrt(sines_edges);
        const Real numerator = distance_ * sine(abs(p - q), outside + Real(2) * min(p, q));
        const auto present = denominator > Real(0);
        const Real quotient = numerator / select(present, denominator, Real(1));
        const Real magnitude = select(present, quotient, Real(kFar)); // beyond the light: its end
        const Real x = min(max(select(p >= q, magnitude, -magnitude), x0_), x1_);

        // The sine h of the elevation of y above the plane y = 0 is uniform. Its distances from 1 and -1 are sums.
        const Real v = select(mirrored_, Real(1) - u.y, u.y);
        const Real rest = select(mirrored_, u.y, Real(1) - u.y);
        const Real squared = fma(x, x, distance_ * distance_);
        const Chord chord = chord_of(squared, y0_, y1_, height_);
        const Real h0 = y0_ / chord.r0;
        const Real range = chord.twist / (chord.r0 * chord.r1);
        const Real below_one = squared / (chord.r1 * (chord.r1 + y1_)); // 1 - h1; y1 is not negative
        const Real above_minus_one =
            select(y0_ < Real(0), squared / (chord.r0 * (chord.r0 - min(y0_, Real(0)))), Real(1) + h0);
        const Real cosine2 = fma(rest, range, below_one) * fma(v, range, above_minus_one);
        const auto open = cosine2 > Real(0);
        const Real height = fma(v, range, h0) * sqrt(squared / select(open, cosine2, Real(1)));
        const Real y = min(max(height, y0_), y1_);

        const auto lit = inverse_total_ > Real(0);
        const Vec3<Real> at = fma(x, x_axis_, fma(y, y_axis_, distance_ * z_axis_));
        const Vec3<Real> p_unit = select(lit, at, z_axis_);
        return {inverse_length(p_unit) * p_unit, inverse_total_, inverse_scale_ * p_unit};
    }

    /// Constant on the light; the caller knows that wi hits it.
    NUSSELT_HD Real pdf(const Vec3<Real>&) const noexcept { return inverse_total_; }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Real ahead = dot(wi, z_axis_);
        const Real along = distance_ / select(ahead > Real(0), ahead, Real(1));
        const Real x = min(max(along * dot(wi, x_axis_), x0_), x1_);
        const Real y = min(max(along * dot(wi, y_axis_), y0_), y1_);
        const Real part = solid_angle(x0_, x, x - x0_, y0_, y1_, height_, distance_);
        const Real squared = fma(x, x, distance_ * distance_);
        const Chord whole = chord_of(squared, y0_, y1_, height_);
        const Chord begun = chord_of(squared, y0_, y, y - y0_);
        const Real all = whole.twist * begun.r1;
        const Real share = begun.twist * whole.r1 / select(all > Real(0), all, Real(1));
        return {below_one(min(max(part * inverse_total_, Real(0)), Real(1))),
                below_one(min(max(select(mirrored_, Real(1) - share, share), Real(0)), Real(1)))};
    }

    /// Solid angle of the light [sr].
    NUSSELT_HD Real measure() const noexcept { return total_; }

private:
    using Scalar = scalar_t<Real>;
    /// Farther than any point of a light with coordinates of order one.
    static constexpr Scalar kFar = 16;
    /// The square of this distance keeps all digits.
    static constexpr Scalar kNear =
        power_of_two<Scalar>(-std::numeric_limits<Scalar>::max_exponent / 32 * 15);

    NUSSELT_HD explicit RectangleSolidAngle(const ScaledPolygon<Real, 4>& unit) noexcept
        : inverse_scale_(unit.inverse_scale) {
        const ConvexPolygon<Real, 4>& light = unit.light;
        // Measure along the edges, from the foot of the perpendicular. Rounding of the edges must not turn one axis into
        // another: a light far away would move by that angle times its distance.
        x_axis_ = inverse_length(light.edge[0]) * light.edge[0];
        const Vec3<Real> across = fma(-dot(light.edge[1], x_axis_), x_axis_, light.edge[1]);
        y_axis_ = inverse_length(across) * across;
        const Vec3<Real> normal = cross(x_axis_, y_axis_);
        const Real signed_distance =
            select(plane_distance(light) == Real(0), Real(0), dot(light.vertex[0], normal));
        distance_ = abs(signed_distance);
        z_axis_ = select(signed_distance >= Real(0), normal, -normal);
        const Real width = length(light.edge[0]);
        height_ = length(light.edge[1]);
        // The edge that is farther from the foot gets the positive y axis.
        x0_ = dot(light.vertex[0], x_axis_);
        x1_ = x0_ + width;
        const Real low = dot(light.vertex[0], y_axis_);
        const Real high = low + height_;
        mirrored_ = low + high < Real(0);
        y0_ = select(mirrored_, -high, low);
        y1_ = select(mirrored_, -low, high);
        y_axis_ = select(mirrored_, -y_axis_, y_axis_);
        // Next to the light, squares of distances would underflow. Rounding of its vertices moves it farther than this.
        const Real beside =
            max(max(x0_, -x1_), max(y0_, -y1_)); // distance of the foot from the light if positive
        const auto touches = (distance_ > Real(0)) & (beside < Real(kNear));
        distance_ = select(touches, max(distance_, Real(kNear)), distance_);

        const auto seen = (distance_ > Real(0)) & (min(width, height_) > Real(0));
        total_ = select(seen, solid_angle(x0_, x1_, width, y0_, y1_, height_, distance_), Real(0));
        const Real density = Real(1) / select(total_ > Real(0), total_, Real(1));
        const auto lit = (total_ > Real(0)) & is_finite(density);
        total_ = select(lit, total_, Real(0));
        inverse_total_ = select(lit, density, Real(0));

        // The strip beyond both ends of the light, and the angles of its edges with the plane of the light.
        const Real half = strip(Real(0));
        const Real beyond0 = strip(abs(x0_));
        const Real beyond1 = strip(abs(x1_));
        left_ = select(x0_ <= Real(0), beyond0, fma(Real(2), half, -beyond0));
        right_ = select(x1_ >= Real(0), beyond1, fma(Real(2), half, -beyond1));
        upper_ = atan2_positive(distance_, y1_);
        lower_ = atan2_positive(distance_, -y0_);
    }

    /// The sine of two angles that sum up to pi, by the smaller one.
    NUSSELT_HD static Real sine(const Real& angle, const Real& supplement) noexcept {
        return sincos_quarter_turn(max(min(angle, supplement), Real(0))).sin;
    }

    /// Two points at (squared, v0) and (squared, v1): their distances, and v1 r0 - v0 r1.
    struct Chord {
        Real r0, r1, twist;
    };
    /// \param squared distance of the line through the points from the origin.
    /// \param extent  v1 - v0, not negative, before rounding of both.
    NUSSELT_HD static Chord chord_of(const Real& squared, const Real& v0, const Real& v1,
                                     const Real& extent) noexcept {
        const Real r0 = sqrt(fma(v0, v0, squared));
        const Real r1 = sqrt(fma(v1, v1, squared));
        const Real sum = fma(v1, r0, v0 * r1);
        const auto same_side = v0 * v1 > Real(0);
        const Real stable = squared * extent * (v0 + v1) / select(same_side, sum, Real(1));
        return {r0, r1, select(same_side, stable, fma(v1, r0, -v0 * r1))};
    }

    /// Solid angle of the part of the strip of all x from v0 to v1 between 0 and u.
    NUSSELT_HD static Real corner(const Real& u, const Real& v0, const Real& v1, const Real& extent,
                                  const Real& distance) noexcept {
        const Chord chord = chord_of(fma(u, u, distance * distance), v0, v1, extent);
        return atan2_positive(abs(u) * distance * max(chord.twist, Real(0)),
                              fma(distance * distance, chord.r0 * chord.r1, u * u * (v0 * v1)));
    }

    /// Solid angle of a triangle with its doubled area and the distance of its plane (Oosterom and Strackee 1983). No dot
    /// product is negative where the foot of the perpendicular is outside of both pairs of edges.
    NUSSELT_HD static Real triangle(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& c,
                                    const Real& product) noexcept {
        const Real ra = sqrt(dot(a, a));
        const Real rb = sqrt(dot(b, b));
        const Real rc = sqrt(dot(c, c));
        return Real(2) *
               atan2_positive(product, ra * rb * rc + dot(a, b) * rc + dot(a, c) * rb + dot(b, c) * ra);
    }

    /// Solid angle of [x0, x1] x [y0, y1] at a distance, with the exact lengths of the edges.
    NUSSELT_HD static Real solid_angle(const Real& x0, const Real& x1, const Real& width, const Real& y0,
                                       const Real& y1, const Real& height, const Real& distance) noexcept {
        // Two parts on both sides of the foot of the perpendicular, in the direction in which it is between the edges.
        const auto between_y = y0 * y1 < Real(0);
        const auto between = between_y | (x0 * x1 < Real(0));
        const Real u0 = select(between_y, y0, x0);
        const Real u1 = select(between_y, y1, x1);
        const Real v0 = select(between_y, x0, y0);
        const Real v1 = select(between_y, x1, y1);
        const Real extent = select(between_y, width, height);
        Real result = corner(u0, v0, v1, extent, distance) + corner(u1, v0, v1, extent, distance);
        if (!all(between)) {
            const Vec3<Real> a{x0, y0, distance};
            const Vec3<Real> c{x1, y1, distance};
            const Real product = width * height * distance;
            const Real triangles =
                triangle(a, {x1, y0, distance}, c, product) + triangle(a, {x0, y1, distance}, c, product);
            result = select(between, result, triangles);
        }
        return result;
    }

    /// Solid angle of the strip between the lines of the upper and the lower edge beyond x >= 0: a spherical triangle, with
    /// the point at infinity as its third vertex.
    NUSSELT_HD Real strip(const Real& x) const noexcept {
        const Real squared = fma(x, x, distance_ * distance_);
        const Chord chord = chord_of(squared, y0_, y1_, height_);
        const Real radii = chord.r0 * chord.r1;
        const Real product = y0_ * y1_;
        const auto opposite = product < Real(0);
        const Real stable =
            squared * (squared + fma(y0_, y0_, y1_ * y1_)) / select(opposite, radii - product, Real(1));
        const Real cosines = select(opposite, stable, radii + product);
        return Real(2) * atan2_positive(height_ * distance_, cosines + fma(x, chord.r0 + chord.r1, squared));
    }

    Vec3<Real> x_axis_, y_axis_, z_axis_; ///< along the edges, and towards the plane
    Real x0_, x1_, y0_, y1_;              ///< of the edges, scaled to an extent of order one; y0 + y1 >= 0
    Real height_;                         ///< y1 - y0 before rounding
    Real distance_;                       ///< of the plane
    Real left_, right_;                   ///< solid angles of the strip beyond the light [sr]
    Real upper_, lower_;                  ///< angles of the upper and lower edge with the plane of the light
    Real total_;
    Real inverse_total_;    ///< the density; 0 without light
    Real inverse_scale_;    ///< a power of two
    mask_t<Real> mirrored_; ///< whether the y axis points against the second edge

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.x_axis_, self.y_axis_, self.z_axis_, self.x0_, self.x1_, self.y0_, self.y1_, self.height_,
              self.distance_, self.left_, self.right_, self.upper_, self.lower_, self.total_,
              self.inverse_total_, self.inverse_scale_, self.mirrored_);
    }
};

NUSSELT_NAMESPACE_END
