#pragma once
/// A plain transcription of a published method, to compare with: the visibility of one line at a time.
///
/// N. Billen, P. Dutre 2016, Line Sampling for Direct Illumination, doi:10.1111/cgf.12948, Sec. 5.2: a line spans a triangle
/// with the shading point. It is tested against the boxes of a hierarchy (T. Akenine-Möller 2005, Fast 3D Triangle-Box
/// Overlap Testing, doi:10.1145/1198555.1198747) and against triangles, whose intersections with it are projected back onto
/// the line. The library finds the visible parts of all lines of a shading point together instead (triangle_shadow.h).

#include <algorithm>
#include <cmath>

#include <nusselt/line_samples/triangle_shadow.h>

NUSSELT_NAMESPACE_BEGIN

/// The triangle between a shading point and a line.
/// \tparam Real float, double or long double.
template <class Real>
class ShadowTriangle {
public:
    /// \param apex       the shading point [m].
    /// \param begin, end of the line [m].
    ShadowTriangle(const Vec3<Real>& apex, const Vec3<Real>& begin, const Vec3<Real>& end) noexcept
        : apex_(apex), to_begin_(begin - apex), to_end_(end - apex), normal_(cross(to_begin_, to_end_)) {
        const Real squared = dot(normal_, normal_);
        inverse_ = squared > 0 ? 1 / squared : 0;
    }

    /// Whether the triangle overlaps a box; 13 axes may separate them.
    /// \param centre, half of the box [m].
    bool overlaps(const Vec3<Real>& centre, const Vec3<Real>& half) const noexcept {
        const Vec3<Real> a = apex_ - centre;
        const Vec3<Real> b = a + to_begin_;
        const Vec3<Real> c = a + to_end_;
        const auto separates = [&](const Vec3<Real>& axis) {
            const Real pa = dot(axis, a);
            const Real pb = dot(axis, b);
            const Real pc = dot(axis, c);
            const Real reach =
                half.x * std::fabs(axis.x) + half.y * std::fabs(axis.y) + half.z * std::fabs(axis.z);
            return std::min({pa, pb, pc}) > reach || std::max({pa, pb, pc}) < -reach;
        };
        const Vec3<Real> axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (const Vec3<Real>& axis : axes)
            if (separates(axis)) return false;
        if (separates(normal_)) return false;
        for (const Vec3<Real>& edge : {to_begin_, to_end_, to_end_ - to_begin_})
            for (const Vec3<Real>& axis : axes)
                if (separates(cross(axis, edge))) return false;
        return true;
    }

    /// What an occluder hides of the line, as shares of its length in [0, 1]; begin >= end if nothing.
    /// \param corner of the occluder [m].
    Interval<Real> hidden_by(const Vec3<Real> (&corner)[3]) const noexcept {
        const Interval<Real> nothing = empty_interval<Real>();
        Real side[3];
        for (int k = 0; k < 3; ++k) side[k] = dot(normal_, corner[k] - apex_);
        Point ends[2];
        int count = 0;
        for (int k = 0; k < 3 && count < 2; ++k) {
            const int next = (k + 1) % 3;
            if ((side[k] < 0) == (side[next] < 0)) continue;
            const Real share = side[k] / (side[k] - side[next]);
            ends[count++] = in_plane(corner[k] + share * (corner[next] - corner[k]) - apex_);
        }
        if (count < 2) return nothing;
        // Occluders count from just beyond the shading point to just before the light.
        if (!clip(ends[0], ends[1], kSmallestDepth, Real(1)) ||
            !clip(ends[0], ends[1], -kShadowEnd<Real>, Real(-1)))
            return nothing;
        const Real t0 = ends[0].along / ends[0].depth;
        const Real t1 = ends[1].along / ends[1].depth;
        return {std::clamp(std::min(t0, t1), Real(0), Real(1)),
                std::clamp(std::max(t0, t1), Real(0), Real(1))};
    }

private:
    static constexpr Real kSmallestDepth = Real(1e-6);

    /// A point in the plane: its depth is 0 at the apex and 1 on the line, where `along` goes from 0 to 1.
    struct Point {
        Real along, depth;
    };

    Point in_plane(const Vec3<Real>& p) const noexcept {
        const Real begin = dot(cross(p, to_end_), normal_) * inverse_;
        const Real end = dot(cross(to_begin_, p), normal_) * inverse_;
        return {end, begin + end};
    }

    /// Keeps what has sign * depth >= bound. \returns whether anything is left
    static bool clip(Point& a, Point& b, Real bound, Real sign) noexcept {
        const Real over_a = sign * a.depth - bound;
        const Real over_b = sign * b.depth - bound;
        if (!(over_a >= 0) && !(over_b >= 0)) return false;
        if (over_a >= 0 && over_b >= 0) return true;
        const Real share = over_a / (over_a - over_b);
        Point& outside = over_a < 0 ? a : b;
        const Point crossing = {a.along + share * (b.along - a.along), a.depth + share * (b.depth - a.depth)};
        outside = crossing;
        return true;
    }

    Vec3<Real> apex_, to_begin_, to_end_, normal_;
    Real inverse_; ///< of the squared length of the normal
};

NUSSELT_NAMESPACE_END
