#pragma once
/// A published method, to compare with: sampling of triangles almost in proportion to the cosine by recursive subdivision.
///
/// C. Ureña 2000, Computation of Irradiance from Triangles by Adaptive Sampling, CGF 19(2), doi:10.1111/1467-8659.00452, as
/// described by C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672,
/// Sec. 2: a triangle is split into four at the middles of its edges, a sample descends to one of them with a probability in
/// proportion to its projected solid angle, by Lambert's formula, and is uniform in solid angle in the last one. Deviations:
/// a fixed depth instead of a bound on the error, so that packs do not diverge; middles of arcs instead of those of planar
/// edges, so that the last triangles of lights close by are small, too; halves of an arc then have half of its Lambert term.
/// Polygons are fans of triangles about vertex 0. Use PolygonProjectedSolidAngle instead.
///
/// Known failures, which the tests show:
/// - The density is not in proportion to the cosine, but constant in each of the last triangles. Each level halves the
///   standard deviation that is left; for lights that cross the horizon, four levels leave five percent.
/// - Neighbouring random numbers can give directions far apart: the map is not continuous.
/// - Lambert's formula takes differences of almost equal numbers for small triangles: in float, the last triangles of a light
///   of a tenth of its distance have errors of a percent.
/// - Coordinates must be of order one, and the plane of the light must not contain the shading point.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/related/clip_vertices.h>
#include <nusselt/related/spherical_triangle_arvo.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam N     bound on the number of vertices before clipping.
/// \tparam Depth number of subdivisions.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], wi.z / measure() up to the failures above.
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
/// Edge cases: no part above the horizon: pdf = 0, measure 0.
template <class Real, int N, int Depth = 4>
class PolygonSubdivisionUrena {
    using Mask = mask_t<Real>;
    static constexpr int kVertices = N + 1;
    static constexpr int kTriangles = N - 1;

public:
    /// \param light in shading space, either winding [m].
    NUSSELT_HD explicit PolygonSubdivisionUrena(const ConvexPolygon<Real, N>& light) noexcept
        : plane_normal_(light.normal),
          plane_distance_(dot(light.normal, light.vertex[0])),
          side_(select(plane_distance_ < Real(0), Real(-1), Real(1))) {
        Vec3<Real> clipped[kVertices];
        Mask all_above = Mask(true);
        for (int j = 0; j < N; ++j) all_above = all_above & (light.vertex[j].z > Real(0));
        if (!all(all_above)) peters::clip_to_slots<N>(light.vertex, clipped);
        for (int j = 0; j < kVertices; ++j) {
            const Vec3<Real>& whole = light.vertex[j < N ? j : N - 1];
            v_[j] = unit(all(all_above) ? whole : select(all_above, whole, clipped[j]));
        }
        // Find the terms of Lambert's formula for all arcs of the fan, so that those of each triangle sum up to its
        // projected solid angle.
        for (int j = 0; j < kVertices - 1; ++j) spoke_[j] = lambert(v_[0], v_[j + 1]);
        total_ = Real(0);
        for (int j = 0; j < kTriangles; ++j) {
            edge_[j] = lambert(v_[j + 1], v_[j + 2]);
            measure_[j] = max(spoke_[j] + edge_[j] - spoke_[j + 1], Real(0));
            total_ = total_ + measure_[j];
        }
        const Mask lit = total_ > Real(0);
        inverse_total_ = select(lit, Real(1) / select(lit, total_, Real(1)), Real(0));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit PolygonSubdivisionUrena(
        const PolygonSubdivisionUrena<Single, N, Depth>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        // Select a triangle of the fan. What is left of the random number is random again.
        Real part = u.x * total_;
        Real measure = measure_[0];
        Node node = fan_triangle(0);
        NUSSELT_UNROLL
        for (int j = 1; j < kTriangles; ++j) {
            const Mask reached = (measure_[j] > Real(0)) & (part >= measure);
            part = select(reached, part - measure, part);
            measure = select(reached, measure_[j], measure);
            node = select_node(reached, fan_triangle(j), node);
        }
        Vec2<Real> left{share_of(part, measure), u.y};
        const Real probability = descend(node, [&left](const Split& split) {
            const Mask right = take(left.x, split.corner_a + split.center, split.corner_b + split.corner_c);
            const Mask upper = take(left.y, select(right, split.corner_b, split.corner_a),
                                    select(right, split.corner_c, split.center));
            return Choice{right, upper};
        });
        const SphericalTriangleArvo<Real> leaf(node.a, node.b, node.c);
        const Vec3<Real> up{Real(0), Real(0), Real(1)};
        const Vec3<Real> inside = leaf.direction(left.x * leaf.solid_angle, left.y);
        const Vec3<Real> wi = select(inverse_total_ > Real(0), inside, up);
        const Real density = measure * inverse_total_ * probability;
        return {wi, over(density, leaf.solid_angle), (plane_distance_ / dot(plane_normal_, wi)) * wi};
    }

    /// \param wi a unit direction on the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept { return locate(wi).pdf; }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept { return locate(wi).u; }

    /// Projected solid angle of the part of the light above the horizon [sr].
    NUSSELT_HD Real measure() const noexcept { return total_; }

private:
    /// A triangle with the terms of Lambert's formula for its arcs; their sum is its projected solid angle.
    struct Node {
        Vec3<Real> a, b, c;
        Real ab, bc, ca;
    };
    /// The four parts of a triangle: their projected solid angles, and the middles of the arcs between them.
    struct Split {
        Vec3<Real> ab, bc, ca;
        Real corner_a, corner_b, corner_c, center;
    };
    /// One of the four: corner a or the center, or to the right corner b or c; the center and c are the upper ones.
    struct Choice {
        Mask right, upper;
    };

    NUSSELT_INLINE static Vec3<Real> unit(const Vec3<Real>& v) noexcept {
        return (Real(1) / sqrt(dot(v, v))) * v;
    }
    /// a / b, or 0 where b is 0.
    NUSSELT_INLINE static Real over(const Real& a, const Real& b) noexcept {
        const Mask present = b > Real(0);
        return select(present, a / select(present, b, Real(1)), Real(0));
    }
    /// a / b in [0, 1).
    NUSSELT_INLINE static Real share_of(const Real& a, const Real& b) noexcept {
        return below_one(over(a, b));
    }

    /// The term of an arc in Lambert's formula, with the sign for this winding.
    NUSSELT_INLINE Real lambert(const Vec3<Real>& a, const Vec3<Real>& b) const noexcept {
        const Vec3<Real> n = peters::cross(a, b);
        const Real sine = sqrt(dot(n, n));
        return over(Real(0.5) * side_ * n.z * peters::atan2_positive(sine, dot(a, b)), sine);
    }

    NUSSELT_INLINE Node fan_triangle(int j) const noexcept {
        return {v_[0], v_[j + 1], v_[j + 2], spoke_[j], edge_[j], -spoke_[j + 1]};
    }
    NUSSELT_INLINE static Node select_node(const Mask& mask, const Node& x, const Node& y) noexcept {
        return {select(mask, x.a, y.a),   select(mask, x.b, y.b),   select(mask, x.c, y.c),
                select(mask, x.ab, y.ab), select(mask, x.bc, y.bc), select(mask, x.ca, y.ca)};
    }

    /// Goes down to one of the smallest triangles.
    /// \param choose called as choose(split) for a Choice on each level.
    /// \returns the probability of these choices.
    template <class Choose>
    NUSSELT_INLINE Real descend(Node& node, const Choose& choose) const noexcept {
        Real probability = Real(1);
        for (int level = 0; level < Depth; ++level) {
            const Vec3<Real>&a = node.a, &b = node.b, &c = node.c;
            const Vec3<Real> ab = unit(a + b), bc = unit(b + c), ca = unit(c + a);
            // Arcs inside of the triangle, with the sign for the corners; the center has the opposite one.
            const Real at_a = lambert(ab, ca), at_b = lambert(bc, ab), at_c = lambert(ca, bc);
            const Real half_ab = Real(0.5) * node.ab;
            const Real half_bc = Real(0.5) * node.bc;
            const Real half_ca = Real(0.5) * node.ca;
            // Rounding can make them negative. The probabilities are relative to what is left of all four.
            const Split split{ab,
                              bc,
                              ca,
                              max(half_ab + at_a + half_ca, Real(0)),
                              max(half_ab + half_bc + at_b, Real(0)),
                              max(half_bc + half_ca + at_c, Real(0)),
                              max(-(at_a + at_b + at_c), Real(0))};
            const Choice choice = choose(split);
            const Mask &right = choice.right, &upper = choice.upper;
            const Real chosen = select(right, select(upper, split.corner_c, split.corner_b),
                                       select(upper, split.center, split.corner_a));
            probability = probability *
                          over(chosen, (split.corner_a + split.center) + (split.corner_b + split.corner_c));
            const Node corner_a{a, ab, ca, half_ab, at_a, half_ca};
            const Node corner_b{ab, b, bc, half_ab, half_bc, at_b};
            const Node corner_c{ca, bc, c, at_c, half_bc, half_ca};
            const Node center{bc, ca, ab, -at_c, -at_a, -at_b};
            node = select_node(right, select_node(upper, corner_c, corner_b),
                               select_node(upper, center, corner_a));
        }
        return probability;
    }

    /// Chooses one of two weights by a random number, which becomes what is left of it.
    /// \returns whether it is the second one.
    NUSSELT_INLINE static Mask take(Real& u, const Real& first, const Real& second) noexcept {
        const Real target = u * (first + second);
        const Mask is_second = (target >= first) & (second > Real(0));
        u = share_of(select(is_second, target - first, target), select(is_second, second, first));
        return is_second;
    }

    /// The part of the unit interval that belongs to a triangle.
    struct Interval {
        Real begin, length;
        /// \param second, is_second as in take().
        NUSSELT_INLINE void narrow(const Real& first, const Real& second, const Mask& is_second) noexcept {
            const Real share = over(first, first + second);
            begin = select(is_second, begin + length * share, begin);
            length = length * select(is_second, Real(1) - share, share);
        }
        NUSSELT_INLINE Real at(const Real& share) const noexcept { return below_one(begin + length * share); }
    };

    struct Location {
        Vec2<Real> u;
        Real pdf;
    };
    NUSSELT_HD Location locate(const Vec3<Real>& wi) const noexcept {
        // The last triangle of the fan whose first spoke wi is behind.
        Node node = fan_triangle(0);
        Real measure = measure_[0];
        Real before = Real(0);
        Real begin = Real(0);
        for (int j = 1; j < kTriangles; ++j) {
            before = before + measure_[j - 1];
            const Mask behind =
                (measure_[j] > Real(0)) & ((measure <= Real(0)) | is_left_of(v_[0], v_[j + 1], wi));
            node = select_node(behind, fan_triangle(j), node);
            begin = select(behind, before, begin);
            measure = select(behind, measure_[j], measure);
        }
        Interval x{begin * inverse_total_, measure * inverse_total_};
        Interval y{Real(0), Real(1)};
        const Real probability = descend(node, [&](const Split& split) {
            const Mask at_a = is_left_of(split.ab, split.ca, wi);
            const Mask at_b = is_left_of(split.bc, split.ab, wi);
            const Mask at_c = is_left_of(split.ca, split.bc, wi);
            const Mask right = at_b | at_c;
            const Mask upper = at_c | !(at_a | at_b);
            const Choice choice{right, upper};
            x.narrow(split.corner_a + split.center, split.corner_b + split.corner_c, choice.right);
            y.narrow(select(choice.right, split.corner_b, split.corner_a),
                     select(choice.right, split.corner_c, split.center), choice.upper);
            return choice;
        });
        const SphericalTriangleArvo<Real> leaf(node.a, node.b, node.c);
        const auto place = leaf.place_of(wi, side_);
        return {{x.at(share_of(place.part, leaf.solid_angle)), y.at(below_one(place.u))},
                over(measure * inverse_total_ * probability, leaf.solid_angle)};
    }
    /// Whether a direction is on the side of an arc on which the light is if the arc runs along its outline.
    NUSSELT_INLINE Mask is_left_of(const Vec3<Real>& begin, const Vec3<Real>& end,
                                   const Vec3<Real>& wi) const noexcept {
        return side_ * dot(peters::cross(begin, end), wi) > Real(0);
    }

    Vec3<Real> plane_normal_;
    Real plane_distance_;
    Real side_;                 ///< sign of the triple product of three vertices
    Vec3<Real> v_[kVertices];   ///< unit directions to the vertices above the horizon
    Real spoke_[kVertices - 1]; ///< terms of Lambert's formula for arcs from vertex 0
    Real edge_[kTriangles];     ///< and for edges of the light
    Real measure_[kTriangles];  ///< projected solid angles of the triangles of the fan
    Real total_;
    Real inverse_total_; ///< 0 without light

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.plane_normal_, self.plane_distance_, self.side_, self.v_, self.spoke_, self.edge_,
              self.measure_, self.total_, self.inverse_total_);
    }
};

NUSSELT_NAMESPACE_END
