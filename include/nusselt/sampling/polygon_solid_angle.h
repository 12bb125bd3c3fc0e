#pragma once
/// Uniform sampling of the solid angle of a convex polygon, for surfaces and for volumes.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 5, supplement C re-derived. The map equals that of Arvo 1995. Deviations: triple products come from
/// edges instead of directions (fan_volumes.h); directions and hit points are sums of the vertices with the same
/// weights, none of which is negative.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/fan_volumes.h>
#include <nusselt/geometry/polygon_measures.h>
#include <nusselt/geometry/polygon_part.h>

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
    NUSSELT_HD explicit PolygonSolidAngle(const ConvexPolygon<Real, N>& light) noexcept {
        FanVolumes<Real, N> volumes(light);
        Real nearest = dot(light.vertex[0], light.vertex[0]); // squared distances
        Real farthest = nearest;
        inverse_distance_[0] = Real(1) / sqrt(nearest);
        NUSSELT_UNROLL
        for (int j = 1; j < N; ++j) {
            const Real squared = dot(light.vertex[j], light.vertex[j]);
            inverse_distance_[j] = Real(1) / sqrt(squared);
            nearest = min(nearest, squared);
            farthest = max(farthest, squared);
        }
        const auto in_range = (nearest > Real(kNear * kNear)) & (farthest < Real(1 / (kNear * kNear)));
        if (all(volumes.conclusive & in_range)) {
            inverse_scale_ = Real(1);
            prepare(light, volumes);
        } else {
            prepare_carefully(light, volumes, in_range);
        }
    }

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
        Triangle t{};
        find_triangle(target, t);

        // Find the corner v, on the arc from a to b, for which the triangle (a, c, v) has the remaining solid angle
        // (Eq. 14). It is the mirror image of a at the direction r = excess a + y (a + b), of any length.
        const Real half = Real(0.5) * (target - t.begin);
        SinCos<Real> angle = sincos_quarter_turn(half);
        if (any(wide_)) {
            const SinCos<Real> wide_angle = sincos_half_turn(half);
            angle = {select(wide_, wide_angle.sin, angle.sin), select(wide_, wide_angle.cos, angle.cos)};
        }
        Real excess = max(multiply_add(t.g0, angle.cos, -t.g1 * angle.sin), Real(0));
        Real y = t.g2_a * angle.sin;
        const auto large = excess + y > Real(kSmall);
        if (!all(large)) {
            // Lanes do not depend on their neighbours: denormal numbers round where they are scaled.
            const Real scale = select(large, Real(1), reciprocal_power_of_two(max(excess, y)));
            excess = scale * excess;
            y = scale * y;
        }
        const Real twice_y = y + y;
        const Real ky = t.one_plus_ab * twice_y;
        const Real squared = max(multiply_add(excess, excess, ky * (excess + y)), Real(kLeast)); // of |r|
        const Real inverse = Real(1) / squared;

        // What follows in terms of |r|^2 = `squared`: v as a weighted sum of a and b, c v, and 1 - c v and 1 + c v.
        const Real weight_a = excess * (excess + twice_y);
        const Real weight_b = multiply_add(twice_y, excess, ky * y);
        const Real cosine = multiply_add(weight_a, t.g2_a - Real(1), weight_b * (t.g2_b - Real(1)));
        Real depth = squared - cosine;
        Real room = squared + cosine;
        Vec3<Real> cv;
        if (any(wide_)) {
            // Weights are large and cancel. Find v from the sum of a and b instead, which is small but accurate.
            const Vec3<Real> c = direction(0);
            const Vec3<Real> a = t.inverse_a * t.pa;
            const Vec3<Real> ab = a + t.inverse_b * t.pb;
            const Vec3<Real> v =
                (inverse * multiply_add(excess, excess, -ky * y)) * a + (inverse * weight_b) * ab;
            const Vec3<Real> chord = v - c;
            cv = v + c;
            depth = select(wide_, squared * (Real(0.5) * dot(chord, chord)), depth);
            room = select(wide_, max(squared * max(Real(0.5) * dot(cv, cv), Real(kOpposite)), Real(kLeast)),
                          room);
        }

        // Choose the point on the arc from c to v: its cosine with c is uniform (Arvo 1995).
        const Real tau = sqrt(u.y * multiply_add(u.y, room, (Real(2) - (u.y + u.y)) * squared) / room);
        depth = inverse * depth;

        // Add the vertices with the weights of their directions, divided by their distances. The sum has the sampled
        // direction and length one up to rounding; divided by the sum of the weights, it is a point of the light.
        const Real at_v = tau * inverse;
        const Real at_a = at_v * weight_a * t.inverse_a;
        const Real at_b = at_v * weight_b * t.inverse_b;
        const Real at_c = max(multiply_add(depth, tau - u.y, Real(1) - tau), Real(0)) * inverse_distance_[0];
        const Vec3<Real> sum = at_a * t.pa + at_b * t.pb + at_c * vertex_[0];
        const Real to_light = inverse_scale_ / max(at_a + at_b + at_c, Real(kLeast));
        LightSample<Real> s{unit_vector(sum), inverse_total_, to_light * sum};
        if (any(wide_)) {
            const Vec3<Real> c = direction(0);
            const Real drop = u.y * depth;
            const Vec3<Real> by_corner = multiply_add(-tau, inverse * room, Real(1) - drop) * c + tau * cv;
            const Vec3<Real> rough = inverse_length(by_corner) * by_corner;
            const Real rough_distance = dot(s.p, rough);
            s.wi = select(wide_, rough, s.wi);
            // From close by, rounding relative to the size of the light would turn the point away from the direction.
            s.p = select(wide_ & (rough_distance < Real(kNearby) * reach()), rough_distance * rough, s.p);

            // Rounding turns the circle by eps / sharpness, and the direction by way of the corner by eps / |c + v|.
            const WideCircle circle(t, angle, c, counterclockwise_);
            const Real rest = multiply_add(u.y, inverse * room, Real(2) - (u.y + u.y));
            const Vec3<Real> wi = circle.direction(drop, rest, c);
            const Real distance = distance_along(wi, t);
            const auto close = distance < min(circle.sharpness, Real(kNearby)) * reach();
            const auto better =
                circle.sharpness * circle.sharpness > Real(kMuchSharper * kMuchSharper) * dot(cv, cv);
            // A triangle that fills much of a hemisphere has a solid angle of more than a quarter of it.
            const auto use_circle = wide_ & (t.g0 > t.g1) & close & better;
            s.wi = select(use_circle, wi, s.wi);
            s.p = select(use_circle, distance * wi, s.p);
        }
        return s;
    }

    /// Constant on the light; the caller knows that wi hits it.
    NUSSELT_HD Real pdf(const Vec3<Real>&) const noexcept { return inverse_total_; }

    /// The random numbers for which sample() returns wi, a unit direction on the light; (0, 0) at vertex 0.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> c = direction(0);
        const Vec3<Real> n = cross(c, wi); // of the great circle through c and wi
        auto found = total_ <= Real(0);
        Vec2<Real> u{Real(0), Real(0)};
        for (int j = 0; j < kTriangles; ++j) {
            const Vec3<Real> a = direction(j + 1);
            const Vec3<Real> b = direction(j + 2);
            // Tell on which sides of the great circle through c and wi the other vertices lie.
            const Real to_b = select(counterclockwise_, dot(n, b), -dot(n, b));
            const Real from_a = select(counterclockwise_, -dot(n, a), dot(n, a));
            // The last triangle also has what rounding moved beyond its end.
            const Real solid_angle = (j + 1 < kTriangles ? begin_[j + 1] : total_) - begin_[j];
            const auto here = (!found) & (solid_angle > Real(0));
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
            u.x = select(here, begin_[j] + min(partial, solid_angle), u.x);
            u.y = select(here, dot(to_wi, to_wi) / select(whole > Real(0), whole, Real(1)), u.y);
            found = found | (here & (to_b > Real(0)));
        }
        return {below_one(u.x / select(total_ > Real(0), total_, Real(1))), below_one(u.y)};
    }

    /// Solid angle of the light [sr].
    NUSSELT_HD Real measure() const noexcept { return total_; }

protected:
    /// \param signed_distance of the plane from the origin as the vertices of the part have it, see plane_distance().
    NUSSELT_HD PolygonSolidAngle(const PolygonPart<Real, N>& part, const Real& signed_distance) noexcept
        : inverse_scale_(part.inverse_scale) {
        find_inverse_distances(part.polygon);
        prepare(part.polygon, FanVolumes<Real, N>(part.polygon, signed_distance));
    }

private:
    /// A triangle of the fan; c is vertex 0 of the polygon, a and b are consecutive vertices.
    struct Triangle {
        Vec3<Real> pa, pb;         ///< vertices
        Real inverse_a, inverse_b; ///< reciprocal distances
        Real g0, g1, g2_a, g2_b;   ///< terms of Eq. 13; G2 of this triangle and of the next one
        Real one_plus_ab;
        Real begin; ///< solid angle of the triangles before
    };

    /// Writes member by member: g++ copies such a large structure of packs through memory.
    /// \param choose picks one of two numbers or vectors: that of triangle j, or what t has.
    template <class Choose>
    NUSSELT_INLINE void update(Triangle& t, int j, const Choose& choose) const noexcept {
        t.pa = choose(vertex_[j + 1], t.pa);
        t.pb = choose(vertex_[j + 2], t.pb);
        t.inverse_a = choose(inverse_distance_[j + 1], t.inverse_a);
        t.inverse_b = choose(inverse_distance_[j + 2], t.inverse_b);
        t.g0 = choose(g0_[j], t.g0);
        t.g1 = choose(g1_[j], t.g1);
        t.g2_a = choose(g2_[j], t.g2_a);
        t.g2_b = choose(g2_[j + 1], t.g2_b);
        t.one_plus_ab = choose(one_plus_ab_[j], t.one_plus_ab);
        t.begin = choose(begin_[j], t.begin);
    }

    /// \param target solid angle from the first arc of the fan on.
    NUSSELT_INLINE void find_triangle(const Real& target, Triangle& t) const noexcept {
        const auto that_of_j = [](const auto& of_j, const auto&) { return of_j; };
        if constexpr (RealTraits<Real>::kLanes == 1) {
            int found = 0;
            for (int j = 1; j < kTriangles; ++j) found += static_cast<int>(target >= begin_[j]);
            update(t, found, that_of_j);
        } else {
            update(t, 0, that_of_j);
            NUSSELT_UNROLL
            for (int j = 1; j < kTriangles; ++j) {
                const auto reached = target >= begin_[j];
                update(t, j,
                       [&](const auto& of_j, const auto& found) { return select(reached, of_j, found); });
            }
        }
    }

    NUSSELT_HD Vec3<Real> direction(int j) const noexcept { return inverse_distance_[j] * vertex_[j]; }

    /// The largest distance of a vertex [m].
    NUSSELT_HD Real reach() const noexcept {
        // Vertices at the origin have a reciprocal distance of 0.
        Real least = Real(std::numeric_limits<Scalar>::max());
        for (int j = 0; j < N; ++j)
            least = select(inverse_distance_[j] > Real(0), min(least, inverse_distance_[j]), least);
        return inverse_scale_ / least;
    }

    /// The great circle of a sample through c and v where v may be almost opposite to c, as for lights that fill a
    /// hemisphere. Then all of their solid angle belongs to corners v next to that point, and v is not accurate enough to
    /// tell the circle. With E = 2 angle, a' perpendicular to a towards b, k = g0 / |a x b| and q = c a', its normal is
    /// proportional to
    ///
    ///     (sin(E) (1 + a c - k^2) - k q cos(E)) a x b / |a x b| +- (2 x y a + (y^2 - x^2) a'),
    ///     x = k cos(angle) - q sin(angle), y = (1 + a c) sin(angle),
    ///
    /// which follows from Eq. 13 for the triangle (a, c, v), solved for the cotangent x / y of half the angle between a and v.
    /// Here all is multiplied by powers of |a x b|.
    struct WideCircle {
        Vec3<Real> tangent; ///< of the circle at c, towards v, of any length
        Real
            sharpness; ///< small if a is almost on one line with b, or opposite to c: k and q then lose digits

        /// \param angle half of the solid angle of the triangle (a, c, v).
        NUSSELT_INLINE WideCircle(const Triangle& t, const SinCos<Real>& angle, const Vec3<Real>& c,
                                  const mask_t<Real>& counterclockwise) noexcept {
            const Vec3<Real> a = t.inverse_a * t.pa;
            const Vec3<Real> n = (t.inverse_a * t.inverse_b) * cross(t.pa, t.pb);
            const Real squared = dot(n, n);
            const Real sine = sqrt(squared);
            const Real q = multiply_add(-t.g2_a, t.one_plus_ab, t.g1);
            const Real x = multiply_add(t.g0, angle.cos, -q * angle.sin);
            const Real y = sine * t.g2_a * angle.sin;
            const Real double_sin = Real(2) * angle.sin * angle.cos;
            const Real double_cos = multiply_add(angle.cos, angle.cos, -angle.sin * angle.sin);
            const Real upright =
                multiply_add(double_sin, multiply_add(t.g2_a, squared, -t.g0 * t.g0), -t.g0 * q * double_cos);
            const Real side = select(counterclockwise, Real(-1), Real(1));
            const Vec3<Real> normal =
                (side * upright) * n + (Real(2) * x * y * sine) * a + (y * y - x * x) * cross(n, a);
            tangent = side * cross(normal, c);
            sharpness = min(sine, sqrt(t.g2_a));
        }

        /// A unit direction on the circle.
        /// \param drop, rest one minus and one plus the cosine of its angle with c.
        NUSSELT_INLINE Vec3<Real> direction(const Real& drop, const Real& rest,
                                            const Vec3<Real>& c) const noexcept {
            const Real rise = sqrt(max(drop * rest, Real(0)));
            const Vec3<Real> wi = (Real(1) - drop) * c + (rise * inverse_length(tangent)) * tangent;
            return inverse_length(wi) * wi;
        }
    };

    /// Distance of the plane of a triangle along a unit direction [m]; the largest number if rounding relative to the reach
    /// of the light would move that point by more: if the triangle is a sliver, or its plane is seen too flat.
    NUSSELT_INLINE Real distance_along(const Vec3<Real>& wi, const Triangle& t) const noexcept {
        const Vec3<Real> to_a = t.pa - vertex_[0];
        const Vec3<Real> to_b = t.pb - vertex_[0];
        const Vec3<Real> normal = cross(to_a, to_b);
        const Real squared = dot(normal, normal);
        const Real volume = t.g0 / (t.inverse_a * t.inverse_b * inverse_distance_[0]);
        const Real cosine = max(abs(dot(normal, wi)), Real(kLeast));
        const Real along = inverse_scale_ * volume / cosine;
        const auto known = squared > Real(kSliver) * dot(to_a, to_a) * dot(to_b, to_b);
        const auto upright = along * sqrt(squared) < Real(kFlattest) * reach() * cosine;
        return select(known & upright, along, Real(std::numeric_limits<Scalar>::max()));
    }

    /// A vector that has length one up to rounding, in most cases, as a unit vector: one step of Newton's iteration.
    NUSSELT_INLINE static Vec3<Real> unit_vector(const Vec3<Real>& a) noexcept {
        const Real squared = dot(a, a);
        Real factor = multiply_add(Real(-0.5), squared, Real(1.5));
        const auto close = abs(squared - Real(1)) < Real(kNewton);
        if (!all(close)) factor = select(close, factor, inverse_length(a));
        return factor * a;
    }

    /// For lights that are seen almost edge-on, very close, very small or very large.
    /// \param volumes  of the light, as they are.
    /// \param in_range whether products of coordinates stay in range.
    NUSSELT_HD void prepare_carefully(const ConvexPolygon<Real, N>& light, FanVolumes<Real, N>& volumes,
                                      const mask_t<Real>& in_range) noexcept {
        inverse_scale_ = Real(1);
        const ConvexPolygon<Real, N>* polygon = &light;
        ScaledPolygon<Real, N> unit;
        if (!all(in_range)) {
            unit = to_unit_extent_where(!in_range, light);
            polygon = &unit.light;
            inverse_scale_ = unit.inverse_scale;
            for (int j = 0; j < N; ++j)
                inverse_distance_[j] =
                    select(in_range, inverse_distance_[j], inverse_length(unit.light.vertex[j]));
            volumes = FanVolumes<Real, N>(unit.light);
        }
        volumes.refine(*polygon);
        prepare(*polygon, volumes);
    }

    NUSSELT_HD void find_inverse_distances(const ConvexPolygon<Real, N>& unit) noexcept {
        // A vertex at the origin implies that no triangle has a solid angle; any direction will do.
        for (int j = 0; j < N; ++j) inverse_distance_[j] = inverse_length(unit.vertex[j]);
    }

    /// \param polygon in the scale of the members.
    NUSSELT_INLINE void prepare(const ConvexPolygon<Real, N>& polygon,
                                const FanVolumes<Real, N>& volumes) noexcept {
        // Sum up directions: the squared length of such a sum is 2 + twice the cosine.
        Vec3<Real> sum[N - 1];
        vertex_[0] = polygon.vertex[0];
        const Vec3<Real> c = direction(0);
        NUSSELT_UNROLL
        for (int j = 0; j < N - 1; ++j) {
            vertex_[j + 1] = polygon.vertex[j + 1];
            sum[j] = direction(j + 1) + c;
            g2_[j] = Real(0.5) * dot(sum[j], sum[j]);
        }

        // Find the terms of Eq. 13. Where two directions are almost opposite, cosines lose what is left of their sum.
        Real least = g2_[N - 2];
        NUSSELT_UNROLL
        for (int j = 0; j < kTriangles; ++j) {
            // One distance after the other: their product might leave the range. Where a vertex is almost at the origin,
            // rounding of edges, divided by its distance, would exceed any triple product of unit vectors.
            g0_[j] = min(abs(volumes.volume[j]) * inverse_distance_[0] * inverse_distance_[j + 1] *
                             inverse_distance_[j + 2],
                         Real(1));
            g1_[j] = dot(sum[j], sum[j + 1]);
            one_plus_ab_[j] = (g1_[j] - g2_[j]) + (Real(2) - g2_[j + 1]);
            least = min(least, min(g2_[j], min(g1_[j], one_plus_ab_[j])));
        }
        wide_ = least < Real(0.25);

        // Find the solid angles (Eq. 13).
        Real half[kTriangles];
        NUSSELT_UNROLL
        for (int j = 0; j < kTriangles; ++j) {
            const Real ratio = min(g0_[j], g1_[j]) / max(g0_[j], g1_[j]);
            const Real octant = atan_up_to_one(ratio);
            half[j] = select(g0_[j] > g1_[j], Real(kPi<Scalar> / 2) - octant, octant);
        }
        if (any(wide_)) prepare_wide(half);
        begin_[0] = Real(0);
        total_ = half[0] + half[0];
        NUSSELT_UNROLL
        for (int j = 1; j < kTriangles; ++j) {
            begin_[j] = total_;
            total_ = total_ + (half[j] + half[j]);
        }
        const auto lit = total_ > Real(kLeast);
        inverse_total_ = select(lit, Real(1) / total_, Real(0));
        counterclockwise_ = volumes.total() >= Real(0);
    }

    /// Finds the terms of Eq. 13 and the solid angles of wide lights.
    /// \param half solid angles of triangles.
    NUSSELT_HD void prepare_wide(Real* half) noexcept {
        const Vec3<Real> c = direction(0);
        for (int j = 0; j < kTriangles; ++j) {
            const Vec3<Real> a = direction(j + 1);
            const Vec3<Real> b = direction(j + 2);
            const Vec3<Real> ab = a + b;
            const Vec3<Real> ac = a + c;
            const Vec3<Real> bc = b + c;
            const Real ab2 = dot(ab, ab);
            const Real ac2 = dot(ac, ac);
            const Real bc2 = dot(bc, bc);
            // Any two of the three sums have the product 1 + a b + a c + b c; the longest one would cancel most.
            const Vec3<Real> s0 = select((ac2 >= ab2) & (ac2 >= bc2), ab, ac);
            const Vec3<Real> s1 = select((bc2 > ab2) & (bc2 > ac2), ab, bc);
            g1_[j] = select(wide_, dot(s0, s1), g1_[j]);
            g2_[j] = max(g2_[j], Real(kOpposite));
            one_plus_ab_[j] = select(wide_, max(Real(0.5) * ab2, Real(kOpposite)), one_plus_ab_[j]);
            half[j] =
                select(wide_, select(g0_[j] > Real(0), atan2_positive(g0_[j], g1_[j]), Real(0)), half[j]);
        }
    }

    using Scalar = scalar_t<Real>;

    /// Vertices that are not closer are normalised without scaling; nor those that are closer than the reciprocal.
    static constexpr Scalar kNear = power_of_two<Scalar>(-20);
    /// Numbers whose fourth powers stay in range.
    static constexpr Scalar kSmall = power_of_two<Scalar>(-24);
    /// Share of the largest distance of a vertex below which a point counts as nearby: rounding relative to the size of the
    /// light then exceeds rounding relative to the distance by a factor of eight, three of 24 bits.
    static constexpr Scalar kNearby = Scalar(0.125);
    /// By which factor the circle must be better to be taken: with errors of one order, the corner also gives the hit point.
    static constexpr Scalar kMuchSharper = Scalar(4);
    /// Largest factor by which a plane that is seen flat may magnify rounding relative to the reach of the light.
    static constexpr Scalar kFlattest = Scalar(16);
    /// Squared sine of the angle at vertex 0 below which a triangle is a sliver: rounding turns its plane by 16 times as
    /// much as that of an upright one.
    static constexpr Scalar kSliver = power_of_two<Scalar>(-8);
    /// The least number whose reciprocal is finite.
    static constexpr Scalar kLeast = 4 * std::numeric_limits<Scalar>::min();
    /// For deviations of a square from one up to this, the error of Newton's iteration is below rounding.
    static constexpr Scalar kNewton = 1 / power_of_two<Scalar>(std::numeric_limits<Scalar>::digits / 2 - 1);
    /// Least value of 1 + the cosine of two directions: the sum of opposite ones is lost to rounding.
    static constexpr Scalar kOpposite =
        std::numeric_limits<Scalar>::epsilon() * std::numeric_limits<Scalar>::epsilon();

    Vec3<Real> vertex_[N];     ///< [m] or, for very large and very small lights, in a unit of order one
    Real inverse_distance_[N]; ///< of the vertices
    Real inverse_scale_;       ///< from the unit to metres, a power of two

    // For each triangle, with unit directions a, b, c to vertices j + 1, j + 2 and 0:
    Real g0_[kTriangles];          ///< triple product, not negative
    Real g1_[kTriangles];          ///< 1 + dot(a, b) + dot(a, c) + dot(b, c)
    Real g2_[N - 1];               ///< 1 + dot(a, c)
    Real one_plus_ab_[kTriangles]; ///< 1 + dot(a, b)
    Real begin_[kTriangles];       ///< solid angle of the triangles before

    Real total_;
    Real inverse_total_; ///< the density; 0 without light
    mask_t<Real>
        wide_; ///< some directions differ by more than a right angle, or the light surrounds the point
    mask_t<Real> counterclockwise_; ///< winding as seen along a ray from the origin through the polygon

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.vertex_, self.inverse_distance_, self.inverse_scale_, self.g0_, self.g1_, self.g2_,
              self.one_plus_ab_, self.begin_, self.total_, self.inverse_total_, self.wide_,
              self.counterclockwise_);
    }
};

/// Uniform sampling of the solid angle of the part of a polygon above the horizon, in shading space.
/// \copydetails PolygonSolidAngle
template <class Real, int N>
class PolygonClippedSolidAngle : public PolygonSolidAngle<Real, N + 1> {
public:
    /// \param light in shading space, either winding [m].
    NUSSELT_HD explicit PolygonClippedSolidAngle(const ConvexPolygon<Real, N>& light) noexcept
        : PolygonClippedSolidAngle(part_above_horizon(light)) {}

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
    /// New vertices are rounded. Whether the plane contains the origin is a question to the whole light. How far away it is
    /// goes by the vertices of the part: the errors of the terms of Eq. 13 then cancel.
    NUSSELT_HD explicit PolygonClippedSolidAngle(const PolygonPart<Real, N + 1>& part) noexcept
        : PolygonSolidAngle<Real, N + 1>(
              part, select(part.plane_distance == Real(0), Real(0), plane_distance(part.polygon))) {}
};

NUSSELT_NAMESPACE_END
