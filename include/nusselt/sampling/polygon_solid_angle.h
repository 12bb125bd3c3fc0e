#pragma once
/// Uniform sampling of the solid angle of a convex polygon, for surfaces and for volumes.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 5, supplement C re-derived. The map equals that of Arvo 1995. Deviations: the triple product is the
/// area of the triangle times the distance of its plane, which cancels nowhere, instead of a Householder
/// reflection; the hit point comes from barycentric coordinates.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/clip_polygon.h>
#include <nusselt/geometry/polygon_measures.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double, one light and shading point per
///              lane.
/// \tparam N    bound on the number of vertices, 3 to 9.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure().
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no area, or origin in the plane of the polygon: pdf = 0, measure 0.
template <class Real, int N>
class PolygonSolidAngle {
    static constexpr int kTriangles = N - 2;

public:
    /// \param light relative to the shading point, either winding [m].
    NUSSELT_HD explicit PolygonSolidAngle(const ConvexPolygon<Real, N>& light) noexcept
        : PolygonSolidAngle(to_unit_extent(light)) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit PolygonSolidAngle(const PolygonSolidAngle<Single, N>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; x selects the great circle through vertex 0, y the point on it, beginning at
    ///          vertex 0.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        // Choose a triangle of the fan in proportion to its solid angle (Sec. 5).
        const Real target = u.x * total_;
        Triangle t = triangle(0);
        Real before = Real(0);
        Real begin = Real(0);
        for (int j = 0; j < kTriangles; ++j) {
            const auto reached = (solid_angle_[j] > Real(0)) & (target >= before);
            if (j > 0 && any(reached)) t = select_triangle(reached, triangle(j), t);
            begin = select(reached, before, begin);
            before = before + solid_angle_[j];
        }
        const Real part = min(max(target - begin, Real(0)), t.solid_angle);

        // Find the corner v, on the arc from a to b, for which the triangle (a, c, v) has the remaining solid angle
        // (Eq. 14). It is the mirror image of a at the direction r = excess a + y (a + b).
        const SinCos<Real> half = sincos_half_turn(Real(0.5) * part);
        const Vec3<Real> ab = t.a + t.b;
        const Real one_plus_ab = max(Real(0.5) * dot(ab, ab), Real(kOpposite));
        Real excess = max(fma(t.g0, half.cos, -t.g1 * half.sin), Real(0));
        Real y = t.g2 * half.sin;
        const Real scale = reciprocal_power_of_two(max(excess, y));
        excess = scale * excess;
        y = scale * y;
        const Real squared = fma(excess, excess, Real(2) * one_plus_ab * y * (excess + y));
        const Real inverse = Real(1) / select(squared > Real(0), squared, Real(1));
        const Real weight_a = excess * (excess + Real(2) * y) * inverse;
        const Real weight_b = Real(2) * y * fma(y, one_plus_ab, excess) * inverse;
        const Real difference = fma(excess, excess, Real(-2) * one_plus_ab * y * y) * inverse;
        const Vec3<Real> v = difference * t.a + weight_b * ab;

        // Choose the point on the arc from c to v: its cosine with c is uniform (Arvo 1995).
        const Vec3<Real> chord = v - direction_[0];
        const Vec3<Real> cv = v + direction_[0];
        const Real depth = Real(0.5) * dot(chord, chord); // 1 - cosine of the arc
        const Real room = max(Real(0.5) * dot(cv, cv), Real(kOpposite));
        const Real tau = sqrt(u.y * fma(u.y, room, Real(2) * (Real(1) - u.y)) / room);
        const Real weight_c = (Real(1) - tau) + depth * (tau - u.y);
        // Unit up to rounding, except where the arc is almost half a turn.
        Vec3<Real> wi = fma(-tau, room, fma(-u.y, depth, Real(1))) * direction_[0] + tau * cv;
        wi = inverse_length(wi) * wi;

        // Find the point of the light in that direction: the same weights, divided by the distances, are its
        // barycentric coordinates up to their sum.
        const Real at_a = max(tau * weight_a, Real(0)) * t.inverse_a;
        const Real at_b = max(tau * weight_b, Real(0)) * t.inverse_b;
        const Real at_c = max(weight_c, Real(0)) * inverse_distance_[0];
        const Real sum = at_a + at_b + at_c;
        const Real normalisation = Real(1) / select(sum > Real(0), sum, Real(1));
        const Vec3<Real> p = (at_a * normalisation) * t.pa + (at_b * normalisation) * t.pb +
                             (at_c * normalisation) * vertex_[0];
        // From close by, rounding relative to the size of the light would turn p away from wi.
        const Real along = dot(p, wi);
        return {wi, inverse_total_, inverse_scale_ * select(along < Real(0.125), along * wi, p)};
    }

    /// Constant on the light; the caller knows that wi hits it.
    NUSSELT_HD Real pdf(const Vec3<Real>&) const noexcept { return inverse_total_; }

    /// The random numbers for which sample() returns wi, a unit direction on the light; (0, 0) at vertex 0.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real>& c = direction_[0];
        const Vec3<Real> n = cross(c, wi); // of the great circle through c and wi
        auto found = total_ <= Real(0);
        Vec2<Real> u{Real(0), Real(0)};
        Real before = Real(0);
        for (int j = 0; j < kTriangles; ++j) {
            const Vec3<Real>& a = direction_[j + 1];
            const Vec3<Real>& b = direction_[j + 2];
            // Tell on which sides of the great circle through c and wi the other vertices lie.
            const Real to_b = select(counterclockwise_, dot(n, b), -dot(n, b));
            const Real from_a = select(counterclockwise_, -dot(n, a), dot(n, a));
            // The last triangle also has what rounding moved beyond its end.
            const auto here = (!found) & (solid_angle_[j] > Real(0));
            // Find v, where the arc from c through wi meets the edge, as the normalised sum of both directions.
            const Real weight_a = max(to_b, Real(0));
            const Real weight_b = max(from_a, Real(0));
            const Vec3<Real> sum = weight_a * a + weight_b * b;
            const Real norm = sqrt(dot(sum, sum));
            const Real inverse = Real(1) / select(norm > Real(0), norm, Real(1));
            const Vec3<Real> v = inverse * sum;
            // The solid angle of (a, c, v) gives u.x (Eq. 13), the chord from c to wi gives u.y.
            const Real partial = Real(2) * atan2_positive(g0_[j] * weight_b * inverse,
                                                          Real(1) + dot(a, c) + dot(a, v) + dot(c, v));
            const Vec3<Real> to_wi = wi - c;
            const Vec3<Real> to_v = v - c;
            const Real whole = dot(to_v, to_v);
            u.x = select(here, before + min(partial, solid_angle_[j]), u.x);
            before = before + solid_angle_[j];
            u.y = select(here, dot(to_wi, to_wi) / select(whole > Real(0), whole, Real(1)), u.y);
            found = found | (here & (to_b > Real(0)));
        }
        return {below_one(u.x / select(total_ > Real(0), total_, Real(1))), below_one(u.y)};
    }

    /// Solid angle of the light [sr].
    NUSSELT_HD Real measure() const noexcept { return total_; }

protected:
    /// \param polygon         with coordinates of order one.
    /// \param inverse_scale   from there to the light.
    /// \param signed_distance of the plane of the polygon from the origin, see plane_distance().
    NUSSELT_HD PolygonSolidAngle(const ConvexPolygon<Real, N>& polygon, const Real& inverse_scale,
                                 const Real& signed_distance) noexcept
        : inverse_scale_(inverse_scale) {
        // Project the vertices to the unit sphere.
        for (int j = 0; j < N; ++j) {
            vertex_[j] = polygon.vertex[j];
            // A vertex at the origin implies that no triangle has a solid angle; any direction will do.
            inverse_distance_[j] = inverse_length(polygon.vertex[j]);
            direction_[j] = inverse_distance_[j] * polygon.vertex[j];
        }
        counterclockwise_ = signed_distance >= Real(0);

        // Prepare the triangles of the fan around vertex 0.
        Vec3<Real> offset = polygon.edge[0];
        total_ = Real(0);
        NUSSELT_UNROLL
        for (int j = 0; j < kTriangles; ++j) {
            const Vec3<Real>& a = direction_[j + 1];
            const Vec3<Real>& c = direction_[0];
            const Vec3<Real>& b = direction_[j + 2];
            // The triple product G0 follows from twice the area of the triangle and the distance of its plane.
            const Real doubled_area = abs(dot(polygon.normal, cross(offset, polygon.edge[j + 1])));
            g0_[j] = abs(signed_distance) * doubled_area * inverse_distance_[0] * inverse_distance_[j + 1] *
                     inverse_distance_[j + 2];
            // Form G1 + G2 and G2 of the paper from sums of directions: two of the three directions may be almost
            // opposite, and cosines would lose what is left of their sum.
            const Vec3<Real> ab = a + b;
            const Vec3<Real> ac = a + c;
            const Vec3<Real> bc = b + c;
            const Real ab2 = dot(ab, ab);
            const Real ac2 = dot(ac, ac);
            const Real bc2 = dot(bc, bc);
            // Any two of the three sums have the product 1 + a b + a c + b c; the longest one would cancel most.
            const Vec3<Real> s0 = select((ac2 >= ab2) & (ac2 >= bc2), ab, ac);
            const Vec3<Real> s1 = select((bc2 > ab2) & (bc2 > ac2), ab, bc);
            g1_[j] = dot(s0, s1);
            g2_[j] = max(Real(0.5) * ac2, Real(kOpposite));
            const Real solid_angle = Real(2) * atan2_positive(g0_[j], g1_[j]); // Eq. 13
            solid_angle_[j] = select(g0_[j] > Real(0), solid_angle, Real(0));
            total_ = total_ + solid_angle_[j];
            offset = offset + polygon.edge[j + 1];
        }
        inverse_total_ = inverse(total_);
    }

private:
    NUSSELT_HD explicit PolygonSolidAngle(const ScaledPolygon<Real, N>& unit) noexcept
        : PolygonSolidAngle(unit.light, unit.inverse_scale, plane_distance(unit.light)) {}

    /// 0 where there is no finite one.
    NUSSELT_HD static Real inverse(const Real& total) noexcept {
        const auto lit = total > Real(0);
        const Real density = Real(1) / select(lit, total, Real(1));
        return select(lit & is_finite(density), density, Real(0));
    }

    /// A triangle of the fan; c is vertex 0 of the polygon, a and b are consecutive vertices.
    struct Triangle {
        Vec3<Real> a, b;              ///< unit directions
        Vec3<Real> pa, pb;            ///< vertices
        Real inverse_a, inverse_b;    ///< reciprocal distances
        Real g0, g1, g2, solid_angle; ///< terms of Eq. 13 and its result
    };

    NUSSELT_HD Triangle triangle(int j) const noexcept {
        return {direction_[j + 1],
                direction_[j + 2],
                vertex_[j + 1],
                vertex_[j + 2],
                inverse_distance_[j + 1],
                inverse_distance_[j + 2],
                g0_[j],
                g1_[j],
                g2_[j],
                solid_angle_[j]};
    }
    NUSSELT_HD static Triangle select_triangle(const mask_t<Real>& mask, const Triangle& a,
                                               const Triangle& b) noexcept {
        return {select(mask, a.a, b.a),
                select(mask, a.b, b.b),
                select(mask, a.pa, b.pa),
                select(mask, a.pb, b.pb),
                select(mask, a.inverse_a, b.inverse_a),
                select(mask, a.inverse_b, b.inverse_b),
                select(mask, a.g0, b.g0),
                select(mask, a.g1, b.g1),
                select(mask, a.g2, b.g2),
                select(mask, a.solid_angle, b.solid_angle)};
    }

    /// Least value of 1 + the cosine of two directions: the sum of opposite ones is lost to rounding.
    static constexpr scalar_t<Real> kOpposite =
        std::numeric_limits<scalar_t<Real>>::epsilon() * std::numeric_limits<scalar_t<Real>>::epsilon();

    Vec3<Real> vertex_[N];     ///< scaled to coordinates of order one
    Vec3<Real> direction_[N];  ///< unit vectors to the vertices
    Real inverse_distance_[N]; ///< of the scaled vertices
    Real inverse_scale_;       ///< a power of two
    Real g0_[kTriangles];      ///< triple product of the directions
    Real g1_[kTriangles];      ///< 1 + dot(a, b) + dot(a, c) + dot(b, c)
    Real g2_[kTriangles];      ///< 1 + dot(a, c)
    Real solid_angle_[kTriangles];
    Real total_;
    Real inverse_total_;            ///< the density; 0 without light
    mask_t<Real> counterclockwise_; ///< winding as seen along a ray from the origin through the polygon

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.vertex_, self.direction_, self.inverse_distance_, self.inverse_scale_, self.g0_, self.g1_,
              self.g2_, self.solid_angle_, self.total_, self.inverse_total_, self.counterclockwise_);
    }
};

/// Uniform sampling of the solid angle of the part of a polygon above the horizon, in shading space.
/// \copydetails PolygonSolidAngle
template <class Real, int N>
class PolygonClippedSolidAngle : public PolygonSolidAngle<Real, N + 1> {
public:
    /// \param light in shading space, either winding [m].
    NUSSELT_HD explicit PolygonClippedSolidAngle(const ConvexPolygon<Real, N>& light) noexcept
        : PolygonClippedSolidAngle(to_unit_extent(light)) {}

    /// \copydoc PolygonSolidAngle::PolygonSolidAngle(const PolygonSolidAngle<Single, N>&)
    template <class Single>
    NUSSELT_HD explicit PolygonClippedSolidAngle(const PolygonClippedSolidAngle<Single, N>& single) noexcept
        : PolygonSolidAngle<Real, N + 1>(static_cast<const PolygonSolidAngle<Single, N + 1>&>(single)) {}

    /// \copydoc PolygonSolidAngle::sample
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        LightSample<Real> s = PolygonSolidAngle<Real, N + 1>::sample(u);
        // Above the horizon in spite of rounding.
        const auto below = s.wi.z < Real(0);
        if (!any(below)) return s;
        s.wi.z = max(s.wi.z, Real(0));
        s.wi = select(below, inverse_length(s.wi) * s.wi, s.wi);
        s.p.z = max(s.p.z, Real(0));
        return s;
    }

private:
    NUSSELT_HD explicit PolygonClippedSolidAngle(const ScaledPolygon<Real, N>& whole) noexcept
        : PolygonClippedSolidAngle(whole, clip_to_horizon(whole.light)) {}

    NUSSELT_HD PolygonClippedSolidAngle(const ScaledPolygon<Real, N>& whole,
                                        const ConvexPolygon<Real, N + 1>& clipped) noexcept
        : PolygonClippedSolidAngle(whole, clipped, to_unit_extent(clipped)) {}

    /// \param unit clipped, scaled once more, since little may be left of the light. New vertices are not exactly on its
    ///             plane: whether that contains the origin is a question to the whole light.
    NUSSELT_HD PolygonClippedSolidAngle(const ScaledPolygon<Real, N>& whole,
                                        const ConvexPolygon<Real, N + 1>& clipped,
                                        const ScaledPolygon<Real, N + 1>& unit) noexcept
        : PolygonSolidAngle<Real, N + 1>(
              unit.light, whole.inverse_scale * unit.inverse_scale,
              select(plane_distance(whole.light) == Real(0), Real(0), plane_distance(clipped)) * unit.scale) {
    }
};

NUSSELT_NAMESPACE_END
