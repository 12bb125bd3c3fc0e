#pragma once
/// Area between two projected great circles and its inversion: the azimuth of a sample when the zenith lies
/// outside the polygon (Peters 2021, polygonal lights, Sec. 3.1 and 3.3 to 3.6).
///
/// The paper describes both circles by ellipses in the tangent plane and directions by homogeneous vectors.
/// Here the unknown is the position on a chord, and the second circle is given by its height above that
/// chord. The formulas are equivalent, step by step, but everything is a difference of neighbouring points: a
/// small light far away keeps the relative precision that the paper loses to the difference of two
/// arctangents.

#include <nusselt/core/trig.h>
#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// What all areas of a sector need: properties of the planes through the origin and both circles. Their normals are
/// those of the segments from the start to x, divided by x.
template <class Real>
struct SectorPlanes {
    Real outer_squared, inner_squared; ///< squared lengths of the normals
    Real squared_step;                 ///< their difference
};

/// Two quads that approximate a sector (Sec. 3.4): each lies between the chords of both ellipses from one end of the
/// range to its middle.
template <class Real>
struct SectorQuads {
    Real middle;                       ///< position
    Real form[2], rise[2];             ///< forms at both ends, see DecentralSector::Forms
    Real outer_root[2], inner_root[2]; ///< roots of the products of the forms at both ends of each chord
    Real squares[2];                   ///< what the squared inner root has more than the outer one
    Real area[2];
};

/// The region of the tangent plane between an outer and an inner great circle, projected, within an azimuth
/// range. Points of the range are x in [0, 1] on a chord of the outer circle's plane.
template <class Real>
struct DecentralSector {
    Vec3<Real> begin;      ///< a point in the plane of the outer circle, at the start of the range
    Vec3<Real> chord;      ///< from there to the end of the range, counterclockwise around the zenith
    Real begin_gap;        ///< height of the plane of the inner circle above the chord at its start, >= 0
    Real end_gap;          ///< the same at its end
    Real doubled_triangle; ///< det(begin, chord) in the tangent plane, > 0

    /// The quadratic forms of both ellipses at a point of the chord, that is, squared distances from the origin.
    struct Forms {
        Vec3<Real> outer_point;
        Real gap;   ///< height of the inner circle's plane above the chord
        Real outer; ///< form of the outer ellipse
        Real rise;  ///< form of the inner ellipse minus that, >= 0
    };

    NUSSELT_INLINE Forms at(const Real& x) const noexcept {
        Forms f;
        f.outer_point = begin + x * chord;
        f.gap = multiply_add(x, end_gap - begin_gap, begin_gap);
        f.outer = dot(f.outer_point, f.outer_point);
        f.rise = max(f.gap * multiply_add(Real(2), f.outer_point.z, f.gap), Real(0));
        return f;
    }

    NUSSELT_INLINE SectorPlanes<Real> planes() const noexcept {
        const Real turn = end_gap - begin_gap;
        const Vec3<Real> outer_normal = cross(begin, chord);
        const Vec3<Real> lift{multiply_add(turn, begin.y, -begin_gap * chord.y),
                              multiply_add(begin_gap, chord.x, -turn * begin.x), Real(0)};
        const Vec3<Real> inner_normal = outer_normal + lift;
        return {dot(outer_normal, outer_normal), dot(inner_normal, inner_normal),
                lift.x * (outer_normal.x + inner_normal.x) + lift.y * (outer_normal.y + inner_normal.y)};
    }

    /// Twice the area from the start to x (Prop. 1 for both ellipses). Each ellipse contributes the
    /// determinant of its end points times angle / sine; the determinants are equal.
    template <class Angles>
    NUSSELT_INLINE Real doubled_area_to(const Real& x, const SectorPlanes<Real>& planes) const noexcept {
        // Describe the end points on both circles by their angles about the origin: cosines, not normalised; the sines
        // are x times the lengths of the normals. The cosine is not a linear function of x: near a right angle, that
        // would cancel more.
        const Real outer_cosine = dot(begin, begin + x * chord);
        const Real gap = multiply_add(x, end_gap - begin_gap, begin_gap);
        const Real rise = multiply_add(begin_gap, multiply_add(x, chord.z, begin.z) + gap, begin.z * gap);
        const Real inner_cosine = outer_cosine + rise;

        // Take the difference of angle / sine of both circles (Eq. 1). Where both angles are at most an eighth of a
        // turn, a polynomial has it as a divided difference.
        const Real x2 = x * x;
        const Real outer_sine2 = x2 * planes.outer_squared;
        const Real inner_sine2 = x2 * planes.inner_squared;
        const Real sine2_step = x2 * planes.squared_step;
        const auto outer_narrow = outer_sine2 <= outer_cosine * outer_cosine;
        const auto inner_narrow = inner_sine2 <= inner_cosine * inner_cosine;
        const auto narrow = (outer_cosine > Real(0)) & outer_narrow & inner_narrow;
        Real difference = Real(0);
        if (any(narrow)) {
            // angle / sine = (1 - k) / cosine with k of the order of the squared angle.
            const Real inverse = Real(1) / select(narrow, outer_cosine * inner_cosine, Real(1));
            const Real outer_inverse = inverse * inner_cosine;
            const Real inner_inverse = inverse * outer_cosine;
            const Real outer_tangent2 = outer_sine2 * outer_inverse * outer_inverse;
            const Real tangent2_step = multiply_add(sine2_step, outer_cosine * outer_cosine,
                                                    -outer_sine2 * rise * (outer_cosine + inner_cosine)) *
                                       inverse * inverse;
            const auto k = one_minus_atan_ratio_difference(min(outer_tangent2, Real(1)), tangent2_step);
            difference = multiply_add(rise * inverse, Real(1) - k.value, inner_inverse * k.difference);
        }
        // Otherwise the difference of the angles is an angle itself.
        if (!all(narrow)) {
            const Real outer_sine = sqrt(outer_sine2);
            const Real inner_sine = sqrt(inner_sine2);
            const auto usable = (outer_sine > Real(0)) & (inner_sine > Real(0));
            const Real more = sine2_step / select(usable, inner_sine + outer_sine, Real(1));
            const Real inner_angle = Angles::atan2_positive(inner_sine, inner_cosine);
            const Real numerator = multiply_add(outer_sine, rise, -more * outer_cosine);
            const Real angle = Angles::atan2_positive(
                abs(numerator), multiply_add(outer_cosine, inner_cosine, outer_sine * inner_sine));
            const Real wide = multiply_add(copysign(angle, numerator), inner_sine, inner_angle * more) /
                              select(usable, outer_sine * inner_sine, Real(1));
            difference = select(narrow, difference, select(usable, wide, Real(0)));
        }
        return max(x * doubled_triangle * difference, Real(0));
    }

    NUSSELT_INLINE SectorQuads<Real> quads() const noexcept {
        // Split the range in its middle, which lies in the direction of the sum of the unit directions to both ends
        // (Eq. 8).
        const Vec3<Real> end = begin + chord;
        const Real r0 = sqrt(dot(xy(begin), xy(begin)));
        const Real r1 = sqrt(dot(xy(end), xy(end)));
        const Real radii = r0 + r1;
        SectorQuads<Real> q;
        q.middle = r0 / select(radii > Real(0), radii, Real(1));
        const Forms half = at(q.middle);
        const Real half_inner = half.outer + half.rise;

        for (int i = 0; i < 2; ++i) {
            const Forms f = at(Real(i));
            const Real inner = f.outer + f.rise;
            q.form[i] = f.outer;
            q.rise[i] = f.rise;
            q.outer_root[i] = sqrt(f.outer * half.outer);
            q.inner_root[i] = sqrt(inner * half_inner);
            q.squares[i] = multiply_add(f.rise, half_inner, f.outer * half.rise);
            const Real width = i == 0 ? q.middle : Real(1) - q.middle;
            q.area[i] = width * q.squares[i] /
                        (q.outer_root[i] * q.inner_root[i] * (q.inner_root[i] + q.outer_root[i]));
        }
        return q;
    }

    /// Samples the quads uniformly.
    /// \param fraction of their area that shall lie before the result.
    NUSSELT_HD static Real initial_position(const Real& fraction, const SectorQuads<Real>& quads) noexcept {
        const Real rest =
            multiply_add(fraction, quads.area[1], multiply_add(fraction, quads.area[0], -quads.area[0]));
        const auto first = rest <= Real(0);
        const auto chosen = [&](const Real(&values)[2]) { return select(first, values[0], values[1]); };

        // With v in [0, 1] from the end of the quad to the middle, the areas below the chords of the ellipses up to v
        // are v / (form (1 - v) + root v). That their difference is the target is a quadratic equation in v (the matrix
        // Q of Sec. 3.4).
        const Real form = chosen(quads.form);
        const Real rise = chosen(quads.rise);
        const Real width = select(first, quads.middle, Real(1) - quads.middle);
        const Real target = max(select(first, rest + quads.area[0], quads.area[1] - rest), Real(0)) /
                            select(width > Real(0), width, Real(1));
        const Real outer_root = chosen(quads.outer_root);
        const Real inner_root = chosen(quads.inner_root);
        const Real outer_slope = outer_root - form;
        const Real inner_form = form + rise;
        const Real inner_slope = inner_root - inner_form;
        const Real more = chosen(quads.squares) / (inner_root + outer_root);
        const Real a = more - rise - target * outer_slope * inner_slope;
        const Real b =
            Real(0.5) * (rise - target * multiply_add(form, inner_slope, outer_slope * inner_form));
        const Real v = min(max(root_near_zero(a, b, -target * form * inner_form), Real(0)), Real(1));
        return select(first, v * width, Real(1) - v * width);
    }

    /// One step of the iteration (Sec. 3.3): replaces both ellipses by their tangents at x. The error is cubed.
    /// \param missing twice the area that shall lie between x and the result.
    NUSSELT_HD Real step(const Real& x, const Real& missing) const noexcept {
        // The values and slopes of both forms at x determine the tangents.
        const Forms f = at(x);
        const Real turn = end_gap - begin_gap;
        const Real inner = f.outer + f.rise;
        const Real outer_slope = dot(f.outer_point, chord);
        const Real rise_slope = multiply_add(f.gap, chord.z, (f.outer_point.z + f.gap) * turn);
        const Real inner_slope = outer_slope + rise_slope;

        // That the area between them is the missing one is a quadratic equation (Eq. 5); take the root that goes to 0
        // with the missing area (Eq. 6).
        const Real a = multiply_add(doubled_triangle, rise_slope, -missing * outer_slope * inner_slope);
        const Real b =
            Real(0.5) * multiply_add(doubled_triangle, f.rise,
                                     -missing * multiply_add(f.outer, inner_slope, inner * outer_slope));
        return min(max(x + root_near_zero(a, b, -missing * f.outer * inner), Real(0)), Real(1));
    }

    /// The position before which the given area lies.
    /// \param target        twice that area, in [0, doubled_total].
    /// \param doubled_total twice the area of the sector, > 0.
    template <int Iterations, class Angles>
    NUSSELT_HD Real position(const Real& target, const Real& doubled_total, const SectorPlanes<Real>& planes,
                             const SectorQuads<Real>& quads) const noexcept {
        const Real fraction = min(target / select(doubled_total > Real(0), doubled_total, Real(1)), Real(1));
        Real x = initial_position(fraction, quads);
        // Rounding of the areas; nothing is gained below.
        const Real tolerance = Real(4 * std::numeric_limits<scalar_t<Real>>::epsilon()) * doubled_total;
        for (int i = 0; i < Iterations; ++i) {
            const Real missing = target - doubled_area_to<Angles>(x, planes); // Eq. 7
            const auto goes_on = abs(missing) > tolerance;
            if (!any(goes_on)) break;
            // Lanes that are done keep their result: it must not depend on their neighbours.
            x = select(goes_on, step(x, missing), x);
        }
        return x;
    }

private:
    /// The root of a x^2 + 2 b x + c = 0 that goes to 0 with c while b > 0, continued (Blinn 2006; Peters
    /// 2021, Eq. 6). A negative discriminant counts as 0.
    NUSSELT_HD static Real root_near_zero(const Real& a, const Real& b, const Real& c) noexcept {
        const Real root = sqrt(max(multiply_add(b, b, -a * c), Real(0)));
        const auto forward = b >= Real(0);
        const Real numerator = select(forward, -c, root - b);
        const Real denominator = select(forward, b + root, a);
        return numerator / select(denominator != Real(0), denominator, Real(1));
    }
};

/// The azimuth of a vertex, which belongs to the outer or the inner edges of a polygon, on an edge of the others.
template <class Real>
struct AzimuthOnEdge {
    Vec2<Real> vertex; ///< its projection to the tangent plane
    Vec3<Real> edge;   ///< from its start to its end, counterclockwise around the zenith
    Vec3<Real> step;   ///< from that start to the vertex
    Real way; ///< determinant of the start with the step in the tangent plane, positive: counterclockwise
    Real
        slope; ///< determinant of the vertex with the edge; the share of the edge up to the azimuth is way / slope

    /// Height of the plane of the inner circle above the outer point at this azimuth. It is the distance of the plane of the
    /// polygon times the step between both chains, over the extent of that plane along the azimuth, by the larger component
    /// of its normal within the vertical plane. All is expressed by determinants, because the difference of both points
    /// cancels where the chains are close to each other, and need not wait for the intersection.
    /// \param normal, distance of the plane of the polygon.
    /// \param divisor if the vertex belongs to the outer edges, minus the determinant of start and end of the edge in the
    ///                 tangent plane; else the slope.
    NUSSELT_INLINE Real gap(const Vec3<Real>& normal, const Real& distance,
                            const Real& divisor) const noexcept {
        const Real upright = normal.z * normal.z * dot(vertex, vertex);
        const Real level = dot(xy(normal), vertex);
        const auto flat = upright >= level * level;
        const Real outward =
            select(flat, det(xy(edge), xy(step)), difference_of_products(step.z, slope, way, edge.z));
        const Real extent = select(flat, normal.z, level) * divisor;
        return max(distance * outward / select(extent == Real(0), Real(1), extent), Real(0));
    }
};

/// Calls visit(member of to, member of from) for all members of two records.
template <class To, class From, class Visit>
NUSSELT_INLINE void visit_members(DecentralSector<To>& to, const DecentralSector<From>& from,
                                  const Visit& visit) noexcept {
    visit_members(to.begin, from.begin, visit);
    visit_members(to.chord, from.chord, visit);
    visit(to.begin_gap, from.begin_gap);
    visit(to.end_gap, from.end_gap);
    visit(to.doubled_triangle, from.doubled_triangle);
}
/// \copydoc visit_members
template <class To, class From, class Visit>
NUSSELT_INLINE void visit_members(SectorPlanes<To>& to, const SectorPlanes<From>& from,
                                  const Visit& visit) noexcept {
    visit(to.outer_squared, from.outer_squared);
    visit(to.inner_squared, from.inner_squared);
    visit(to.squared_step, from.squared_step);
}
/// \copydoc visit_members
template <class To, class From, class Visit>
NUSSELT_INLINE void visit_members(SectorQuads<To>& to, const SectorQuads<From>& from,
                                  const Visit& visit) noexcept {
    visit(to.middle, from.middle);
    for (int i = 0; i < 2; ++i) {
        visit(to.form[i], from.form[i]);
        visit(to.rise[i], from.rise[i]);
        visit(to.outer_root[i], from.outer_root[i]);
        visit(to.inner_root[i], from.inner_root[i]);
        visit(to.squares[i], from.squares[i]);
        visit(to.area[i], from.area[i]);
    }
}

NUSSELT_NAMESPACE_END
