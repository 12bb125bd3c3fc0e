#pragma once
/// Parallel lines that cover a convex polygonal light: a point of the light is an offset, which chooses the line, and a
/// coordinate along it.
///
/// N. Billen, P. Dutre 2016, Line Sampling for Direct Illumination, CGF 35(4), doi:10.1111/cgf.12948: Sec. 4 and 5.1.
/// Deviations: convex polygons instead of triangles; the density of Sec. 5.1.2 peaks at 2 / (b - a), not 2 / area.

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

/// From infinity to minus infinity, so that unions are a minimum and a maximum.
template <class Real>
NUSSELT_HD inline Interval<Real> empty_interval() noexcept {
    constexpr scalar_t<Real> kInfinity = std::numeric_limits<scalar_t<Real>>::infinity();
    return {Real(kInfinity), Real(-kInfinity)};
}

/// What a light has of a line.
template <class Real>
struct Chord {
    Real offset; ///< [m]
    Interval<Real> extent;
};

/// A part of a line of the light.
template <class Real>
NUSSELT_HD inline LineSegment<Real> segment_of(const LinePlane<Real>& plane, const Real& offset,
                                               const Interval<Real>& part) noexcept {
    return {fma(part.begin, plane.along, fma(offset, plane.across, plane.origin)), plane.along,
            max(part.end - part.begin, Real(0))};
}

/// A line by its offset, with the density of that.
template <class Real>
struct LineChoice {
    Real offset; ///< [m]
    Real pdf;    ///< of the offset [1/m]; 0: the light has no area
};

/// \tparam Real with packs, a family per lane.
/// \tparam N    bound on the number of vertices of the light.
template <class Real, int N>
class LineFamily {
public:
    /// \param light in any space.
    /// \param angle of the lines with the longest edge of the light, in [0, pi).
    NUSSELT_HD LineFamily(const ConvexPolygon<Real, N>& light, const Real& angle) noexcept {
        Vec3<Real> longest = light.edge[0];
        for (int j = 1; j < N; ++j)
            longest =
                select(dot(light.edge[j], light.edge[j]) > dot(longest, longest), light.edge[j], longest);
        const Vec3<Real> tangent = normalize(longest);
        const Vec3<Real> bitangent = cross(light.normal, tangent);
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
    NUSSELT_HD explicit LineFamily(const LineFamily<Single, N>& single) noexcept
        : plane_{broadcast<Real>(single.plane_.origin), broadcast<Real>(single.plane_.across),
                 broadcast<Real>(single.plane_.along), broadcast<Real>(single.plane_.normal)},
          area_(single.area_) {
        for (int k = 0; k < N; ++k)
            knot_[k] = {Real(single.knot_[k].offset),
                        {Real(single.knot_[k].extent.begin), Real(single.knot_[k].extent.end)}};
    }

    NUSSELT_HD const LinePlane<Real>& plane() const noexcept { return plane_; }

    /// Of all lines of the light [m].
    NUSSELT_HD Interval<Real> offsets() const noexcept { return {knot_[0].offset, knot_[N - 1].offset}; }

    /// \param u in [0, 1).
    NUSSELT_HD LineChoice<Real> sample_uniform(const Real& u) const noexcept {
        const Real extent = knot_[N - 1].offset - knot_[0].offset;
        const auto lit = (extent > Real(0)) & (area_ > Real(0));
        return {fma(u, extent, knot_[0].offset),
                select(lit, Real(1) / select(lit, extent, Real(1)), Real(0))};
    }

    /// With a density in proportion to the length of the line on the light.
    /// \param u in [0, 1); increasing u increases the offset.
    NUSSELT_HD LineChoice<Real> sample_by_length(const Real& u) const noexcept {
        const Real target = u * area_;
        Real below = Real(0);
        Chord<Real> left = knot_[0];
        Chord<Real> right = knot_[1];
        Real rest = target;
        for (int k = 1; k + 1 < N; ++k) {
            below = below + area_between(knot_[k - 1], knot_[k]);
            const auto beyond = target >= below;
            left = select(beyond, knot_[k], left);
            right = select(beyond, knot_[k + 1], right);
            rest = select(beyond, target - below, rest);
        }
        const Real l0 = left.extent.end - left.extent.begin;
        const Real l1 = right.extent.end - right.extent.begin;
        const Real width = right.offset - left.offset;
        const Real part = area_between(left, right);
        const Real x = min(rest / select(part > Real(0), part, Real(1)), Real(1));
        const Real denominator = l0 + sqrt(max(fma(x, l1 * l1 - l0 * l0, l0 * l0), Real(0)));
        const Real step = x * (l0 + l1) / select(denominator > Real(0), denominator, Real(1));
        const Real offset = fma(width, min(step, Real(1)), left.offset);
        return {offset, pdf_by_length(offset)};
    }

    /// Density of the offsets of sample_by_length() [1/m].
    NUSSELT_HD Real pdf_by_length(const Real& offset) const noexcept {
        const Interval<Real> extent = chord(offset).extent;
        const auto lit = area_ > Real(0);
        return select(lit, (extent.end - extent.begin) / select(lit, area_, Real(1)), Real(0));
    }

    /// \param offset beyond those of the light, the closest line of the light counts.
    NUSSELT_HD Chord<Real> chord(const Real& offset) const noexcept {
        Chord<Real> left = knot_[0];
        Chord<Real> right = knot_[1];
        for (int k = 1; k + 1 < N; ++k) {
            const auto beyond = offset >= knot_[k].offset;
            left = select(beyond, knot_[k], left);
            right = select(beyond, knot_[k + 1], right);
        }
        const Real width = right.offset - left.offset;
        const Real x =
            min(max((offset - left.offset) / select(width > Real(0), width, Real(1)), Real(0)), Real(1));
        const Real begin = fma(x, right.extent.begin - left.extent.begin, left.extent.begin);
        const Real end = fma(x, right.extent.end - left.extent.end, left.extent.end);
        return {offset, {begin, max(begin, end)}};
    }

    /// Of the light [m^2].
    NUSSELT_HD Real area() const noexcept { return area_; }

private:
    template <class, int>
    friend class LineFamily;

    NUSSELT_HD static Chord<Real> select(const mask_t<Real>& mask, const Chord<Real>& a,
                                         const Chord<Real>& b) noexcept {
        using nusselt::select;
        return {select(mask, a.offset, b.offset),
                {select(mask, a.extent.begin, b.extent.begin), select(mask, a.extent.end, b.extent.end)}};
    }
    template <class T>
    NUSSELT_HD static T select(const mask_t<Real>& mask, const T& a, const T& b) noexcept {
        using nusselt::select;
        return select(mask, a, b);
    }

    /// The area that lines between two knots cover.
    NUSSELT_HD static Real area_between(const Chord<Real>& a, const Chord<Real>& b) noexcept {
        const Real lengths = (a.extent.end - a.extent.begin) + (b.extent.end - b.extent.begin);
        return Real(0.5) * lengths * (b.offset - a.offset);
    }

    /// Finds the lines through the vertices.
    NUSSELT_HD void project(const ConvexPolygon<Real, N>& light) noexcept;

    LinePlane<Real> plane_;
    Chord<Real> knot_[N]; ///< through the vertices, by increasing offset; between them chords are linear
    Real area_;
};

template <class Real, int N>
NUSSELT_HD inline void LineFamily<Real, N>::project(const ConvexPolygon<Real, N>& light) noexcept {
    // From edges: differences of vertices would lose the size of small lights far away.
    Real u[N];
    Real t[N];
    u[0] = t[0] = Real(0);
    for (int j = 0; j + 1 < N; ++j) {
        u[j + 1] = u[j] + dot(light.edge[j], plane_.across);
        t[j + 1] = t[j] + dot(light.edge[j], plane_.along);
    }
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
    // Insertion sort with static indices.
    for (int i = 1; i < N; ++i)
        for (int k = i; k > 0; --k) {
            const auto swaps = knot_[k].offset < knot_[k - 1].offset;
            const Chord<Real> lower = select(swaps, knot_[k], knot_[k - 1]);
            knot_[k] = select(swaps, knot_[k - 1], knot_[k]);
            knot_[k - 1] = lower;
        }
    area_ = Real(0);
    for (int k = 0; k + 1 < N; ++k) area_ = area_ + area_between(knot_[k], knot_[k + 1]);
}

NUSSELT_NAMESPACE_END
