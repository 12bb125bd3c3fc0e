#pragma once
/// Parallel lines that cover a convex polygonal light: a point of the light is an offset, which chooses the line, and a
/// coordinate along it.
///
/// N. Billen, P. Dutre 2016, Line Sampling for Direct Illumination, CGF 35(4), doi:10.1111/cgf.12948: Sec. 4 and 5.1.
/// Deviations: convex polygons instead of triangles; the density of Sec. 5.1.2 peaks at 2 / (b - a), not 2 / area.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/trig.h>
#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/line_segment.h>

NUSSELT_NAMESPACE_BEGIN

/// The plane of a light with coordinates: origin + offset * across + t * along.
template <class Real>
struct LinePlane {
    Vec3<Real> origin; ///< the first vertex of the light [m]
    Vec3<Real> across; ///< unit, perpendicular to the lines
    Vec3<Real> along;  ///< unit, the direction of the lines
    Vec3<Real> normal; ///< unit, cross(across, along)
};

/// The same plane in all lanes.
template <class Real, class Single>
NUSSELT_HD inline LinePlane<Real> broadcast(const LinePlane<Single>& plane) noexcept {
    return {broadcast<Real>(plane.origin), broadcast<Real>(plane.across), broadcast<Real>(plane.along),
            broadcast<Real>(plane.normal)};
}

/// The plane seen from a shading point: the point becomes the origin, the normal of the frame +z.
/// \tparam Real may be a pack while the plane is scalar.
template <class Real, class LightReal>
NUSSELT_HD inline LinePlane<Real> to_shading_space(const LinePlane<LightReal>& world, const Vec3<Real>& point,
                                                   const Frame<Real>& frame) noexcept {
    return {frame.to_local(broadcast<Real>(world.origin) - point),
            frame.to_local(broadcast<Real>(world.across)), frame.to_local(broadcast<Real>(world.along)),
            frame.to_local(broadcast<Real>(world.normal))};
}

/// Coordinates along a line [m]; nothing where begin >= end.
template <class Real>
struct Interval {
    Real begin, end;
};

/// The interval from infinity to minus infinity, so that unions are a minimum and a maximum.
template <class Real>
NUSSELT_HD inline Interval<Real> empty_interval() noexcept {
    constexpr scalar_t<Real> kInfinity = std::numeric_limits<scalar_t<Real>>::infinity();
    return {Real(kInfinity), Real(-kInfinity)};
}

/// The part of a line on the light.
template <class Real>
struct Chord {
    Real offset; ///< [m]
    Interval<Real> extent;
};

/// The same chord in all lanes.
template <class Real, class Single>
NUSSELT_HD inline Chord<Real> broadcast(const Chord<Single>& chord) noexcept {
    return {Real(chord.offset), {Real(chord.extent.begin), Real(chord.extent.end)}};
}

/// A part of a line of the light.
template <class Real>
NUSSELT_HD inline LineSegment<Real> segment_of(const LinePlane<Real>& plane, const Real& offset,
                                               const Interval<Real>& part) noexcept {
    return {fma(part.begin, plane.along, fma(offset, plane.across, plane.origin)), plane.along,
            max(part.end - part.begin, Real(0))};
}

/// The part of a line that is not below the horizon of a point.
/// \param to_begin, to_end from the point to the ends of the line [m]
/// \param normal         of the surface, in the same space
/// \param whole          coordinates of these ends [m]
template <class Real>
NUSSELT_HD inline Interval<Real> part_above_horizon(const Vec3<Real>& to_begin, const Vec3<Real>& to_end,
                                                    const Vec3<Real>& normal,
                                                    const Interval<Real>& whole) noexcept {
    const Real begin = dot(normal, to_begin);
    const Real end = dot(normal, to_end);
    const Real difference = begin - end;
    const Real share = begin / select(difference == Real(0), Real(1), difference);
    const Real crossing = min(max(fma(share, whole.end - whole.begin, whole.begin), whole.begin), whole.end);
    const auto begins_below = begin < Real(0);
    const auto ends_below = end < Real(0);
    const Interval<Real> none = empty_interval<Real>();
    return {select(begins_below, select(ends_below, none.begin, crossing), whole.begin),
            select(ends_below, select(begins_below, none.end, crossing), whole.end)};
}

/// A line by its offset, with the density of that.
template <class Real>
struct LineChoice {
    Real offset; ///< [m]
    Real pdf;    ///< of the offset [1/m]; 0: the light has no area, or not in this line
};

/// \tparam Real with packs, a family per lane.
/// \tparam N    bound on the number of vertices of the light.
///
/// Lights without area have lines without length and densities of 0; everything is finite for any extent of the light.
/// Offsets, coordinates and densities belong to the light alone. They are accurate relative to the light's extent,
/// however far away the light is.
template <class Real, int N>
class LineFamily {
public:
    /// \param light in any space.
    /// \param angle of the lines with the longest edge of the light, in [0, pi).
    NUSSELT_HD LineFamily(const ConvexPolygon<Real, N>& light, const Real& angle) noexcept {
        // Scale the light to an extent of order one and find its longest edge.
        Real extent = Real(0);
        for (int j = 0; j < N; ++j) {
            const Vec3<Real>& edge = light.edge[j];
            extent = max(max(max(abs(edge.x), abs(edge.y)), abs(edge.z)), extent);
        }
        scale_ = reciprocal_power_of_two(extent);
        Vec3<Real> longest = scale_ * light.edge[0];
        for (int j = 1; j < N; ++j) {
            const Vec3<Real> edge = scale_ * light.edge[j];
            longest = select(dot(edge, edge) > dot(longest, longest), edge, longest);
        }

        // Complete that edge to a basis of the plane. Edges of tiny lights far from the origin of their space are
        // rounded out of the plane.
        const Vec3<Real> bitangent = normalize(cross(light.normal, longest));
        const Vec3<Real> tangent = cross(bitangent, light.normal);

        // Turn the basis by the angle (Sec. 5.1.1).
        const SinCos<Real> half = sincos_quarter_turn(Real(0.5) * angle);
        const Real sine = Real(2) * half.sin * half.cos;
        const Real cosine = fma(Real(-2) * half.sin, half.sin, Real(1));
        plane_.origin = light.vertex[0];
        plane_.along = cosine * tangent + sine * bitangent;
        plane_.across = cross(plane_.along, light.normal);
        plane_.normal = light.normal;
        project(light);
    }

    /// Broadcasts a family to all lanes of a pack, to take many lines of one light.
    template <class Single>
    NUSSELT_HD explicit LineFamily(const LineFamily<Single, N>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_HD const LinePlane<Real>& plane() const noexcept { return plane_; }

    /// The range of the offsets of all lines of the light [m].
    NUSSELT_HD Interval<Real> offsets() const noexcept { return {knot_[0].offset, knot_[N - 1].offset}; }

    /// \param u in [0, 1); increasing u increases the offset.
    NUSSELT_HD LineChoice<Real> sample_uniform(const Real& u) const noexcept {
        const Interval<Real> all = offsets();
        return {min(fma(u, all.end - all.begin, all.begin), all.end), pdf_uniform()};
    }

    /// Density of the offsets of sample_uniform() [1/m].
    NUSSELT_HD Real pdf_uniform() const noexcept {
        const Interval<Real> all = offsets();
        const Real extent = all.end - all.begin;
        const auto lit = (extent > Real(0)) & (scaled_area_ > Real(0));
        return select(lit, Real(1) / select(lit, extent, Real(1)), Real(0));
    }

    /// The random number that sample_uniform() makes this offset from, in [0, 1).
    NUSSELT_HD Real invert_uniform(const Real& offset) const noexcept {
        return below_one((offset - offsets().begin) * pdf_uniform());
    }

    /// Largest absolute value of the offsets and of the coordinates along lines [m].
    NUSSELT_HD Real reach() const noexcept {
        Real largest = Real(0);
        for (const Chord<Real>& knot : knot_)
            largest = max(max(max(abs(knot.extent.begin), abs(knot.extent.end)), abs(knot.offset)), largest);
        return largest;
    }

    /// Samples lines in proportion to their length on the light.
    /// \param u in [0, 1); increasing u increases the offset.
    NUSSELT_HD LineChoice<Real> sample_by_length(const Real& u) const noexcept {
        // Choose the part between two neighbouring vertices in proportion to its area (Sec. 5.1.2).
        const Real target = u * scaled_area_;
        Real below = Real(0);
        Real rest = target;
        Span span{knot_[0], knot_[1]};
        for (int k = 1; k + 1 < N; ++k) {
            below = below + scaled_area({knot_[k - 1], knot_[k]});
            const auto beyond = target >= below;
            span = select(beyond, Span{knot_[k], knot_[k + 1]}, span);
            rest = select(beyond, target - below, rest);
        }

        // In it, the length of the lines is a linear function of the offset: invert its integral.
        const Real l0 = scale_ * length_of(span.left);
        const Real l1 = scale_ * length_of(span.right);
        const Real area = scaled_area(span);
        const Real x = min(rest / select(area > Real(0), area, Real(1)), Real(1));
        // The sum in the denominator avoids a difference of nearly equal lengths.
        const Real denominator = l0 + sqrt(max(fma(x, l1 * l1 - l0 * l0, l0 * l0), Real(0)));
        const Real step = x * (l0 + l1) / select(denominator > Real(0), denominator, Real(1));
        const Real width = span.right.offset - span.left.offset;
        const Real offset = min(fma(width, min(step, Real(1)), span.left.offset), span.right.offset);
        return {offset, pdf_by_length(offset)};
    }

    /// Density of the offsets of sample_by_length() [1/m].
    NUSSELT_HD Real pdf_by_length(const Real& offset) const noexcept {
        const auto lit = scaled_area_ > Real(0);
        const Real length = scale_ * length_of(chord(offset));
        return select(lit, length / select(lit, scaled_area_, Real(1)), Real(0));
    }

    /// The random number that sample_by_length() makes this offset from, in [0, 1); 0 for lights without area.
    NUSSELT_HD Real invert_by_length(const Real& offset) const noexcept {
        Real below = Real(0);
        Real before = Real(0);
        Span span{knot_[0], knot_[1]};
        for (int k = 1; k + 1 < N; ++k) {
            below = below + scaled_area({knot_[k - 1], knot_[k]});
            const auto beyond = offset >= knot_[k].offset;
            span = select(beyond, Span{knot_[k], knot_[k + 1]}, span);
            before = select(beyond, below, before);
        }
        Chord<Real> here = chord(offset);
        here.offset = min(max(offset, span.left.offset), span.right.offset);
        const auto lit = scaled_area_ > Real(0);
        const Real area = before + scaled_area({span.left, here});
        return below_one(area / select(lit, scaled_area_, Real(1)));
    }

    /// \param offset beyond those of the light, the closest line of the light counts.
    NUSSELT_HD Chord<Real> chord(const Real& offset) const noexcept {
        Span span{knot_[0], knot_[1]};
        for (int k = 1; k + 1 < N; ++k)
            span = select(offset >= knot_[k].offset, Span{knot_[k], knot_[k + 1]}, span);
        const Chord<Real>& left = span.left;
        const Chord<Real>& right = span.right;
        const Real width = right.offset - left.offset;
        const Real x =
            min(max((offset - left.offset) / select(width > Real(0), width, Real(1)), Real(0)), Real(1));
        const Real begin = fma(x, right.extent.begin - left.extent.begin, left.extent.begin);
        const Real end = fma(x, right.extent.end - left.extent.end, left.extent.end);
        return {offset, {begin, max(begin, end)}};
    }

    /// Area of the light [m^2].
    NUSSELT_HD Real area() const noexcept { return scaled_area_ / scale_; }

private:
    /// Neighbouring knots.
    struct Span {
        Chord<Real> left, right;
    };

    NUSSELT_HD static Chord<Real> select(const mask_t<Real>& mask, const Chord<Real>& a,
                                         const Chord<Real>& b) noexcept {
        using nusselt::select;
        return {select(mask, a.offset, b.offset),
                {select(mask, a.extent.begin, b.extent.begin), select(mask, a.extent.end, b.extent.end)}};
    }
    NUSSELT_HD static Span select(const mask_t<Real>& mask, const Span& a, const Span& b) noexcept {
        return {select(mask, a.left, b.left), select(mask, a.right, b.right)};
    }
    template <class T>
    NUSSELT_HD static T select(const mask_t<Real>& mask, const T& a, const T& b) noexcept {
        using nusselt::select;
        return select(mask, a, b);
    }

    NUSSELT_HD static Real length_of(const Chord<Real>& chord) noexcept {
        return chord.extent.end - chord.extent.begin;
    }

    /// The area that lines between two knots cover, times the scale.
    NUSSELT_HD Real scaled_area(const Span& span) const noexcept {
        const Real mean_length = Real(0.5) * length_of(span.left) + Real(0.5) * length_of(span.right);
        return mean_length * (scale_ * (span.right.offset - span.left.offset));
    }

    /// Finds the lines through the vertices.
    NUSSELT_HD void project(const ConvexPolygon<Real, N>& light) noexcept;

    LinePlane<Real> plane_;
    Chord<Real> knot_[N]; ///< through the vertices, by increasing offset; between them chords are linear
    Real scale_;          ///< a power of two: one over the extent of the light, up to a factor of 2
    Real scaled_area_;    ///< area times the scale [m]: areas themselves leave the range of Real earlier

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.plane_, self.knot_, self.scale_, self.scaled_area_);
    }
};

template <class Real, int N>
NUSSELT_HD inline void LineFamily<Real, N>::project(const ConvexPolygon<Real, N>& light) noexcept {
    // Find the coordinates of the vertices, from edges: differences of vertices would lose the size of small lights far
    // away.
    Real u[N];
    Real t[N];
    u[0] = t[0] = Real(0);
    for (int j = 0; j + 1 < N; ++j) {
        u[j + 1] = u[j] + dot(light.edge[j], plane_.across);
        t[j + 1] = t[j] + dot(light.edge[j], plane_.along);
    }

    // Find the chord through each vertex, by where its line crosses the other edges.
    for (int k = 0; k < N; ++k) {
        knot_[k] = {u[k], {t[k], t[k]}};
        for (int j = 0; j < N; ++j) {
            const int next = j + 1 < N ? j + 1 : 0;
            const Real run = u[next] - u[j];
            const Real x = (u[k] - u[j]) / select(run == Real(0), Real(1), run);
            const auto crosses = (x >= Real(0)) & (x <= Real(1)) & ((run != Real(0)) | (u[k] == u[j]));
            const Real at = fma(x, t[next] - t[j], t[j]);
            knot_[k].extent.begin = select(crosses, min(knot_[k].extent.begin, at), knot_[k].extent.begin);
            knot_[k].extent.end = select(crosses, max(knot_[k].extent.end, at), knot_[k].extent.end);
        }
    }

    // Sort the chords by offset: an insertion sort with static indices.
    for (int i = 1; i < N; ++i)
        for (int k = i; k > 0; --k) {
            const auto swaps = knot_[k].offset < knot_[k - 1].offset;
            const Chord<Real> lower = select(swaps, knot_[k], knot_[k - 1]);
            knot_[k] = select(swaps, knot_[k - 1], knot_[k]);
            knot_[k - 1] = lower;
        }

    // Add up the area.
    scaled_area_ = Real(0);
    for (int k = 0; k + 1 < N; ++k) scaled_area_ = scaled_area_ + scaled_area({knot_[k], knot_[k + 1]});
}

NUSSELT_NAMESPACE_END
