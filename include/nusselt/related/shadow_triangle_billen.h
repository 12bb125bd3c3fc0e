#pragma once
/// A published method, to compare with: the visibility of one line at a time. Scalar code for the host alone.
///
/// N. Billen, P. Dutre 2016, Line Sampling for Direct Illumination, doi:10.1111/cgf.12948, Sec. 5.2: a line spans a triangle
/// with the shading point. It is tested against the boxes of a hierarchy (T. Akenine-Möller 2005, Fast 3D Triangle-Box
/// Overlap Testing, doi:10.1145/1198555.1198747) and against triangles, whose intersections with it are projected back onto
/// the line. The library finds the visible parts of all lines of a shading point together instead (triangle_shadow.h).
///
/// What differs from the paper: the axes that may separate the triangle from boxes are found once for all boxes, and
/// VisibleParts keeps the visible parts in an array, where the authors have a binary tree, which is faster for lines in very
/// many parts only.

#include <algorithm>
#include <cmath>

#include <nusselt/line_samples/triangle_shadow.h>

NUSSELT_NAMESPACE_BEGIN

/// The triangle between a shading point and a line. A line of no length, or one that passes through the shading point, spans
/// none: it overlaps boxes around its vertices, and no occluder hides any of it.
/// \tparam Real float, double or long double.
template <class Real>
class ShadowTriangle {
public:
    /// \param apex       the shading point [m].
    /// \param begin, end of the line [m].
    ShadowTriangle(const Vec3<Real>& apex, const Vec3<Real>& begin, const Vec3<Real>& end) noexcept
        : apex_(apex), normal_(cross(begin - apex, end - apex)) {
        const Vec3<Real> to_begin = begin - apex;
        const Vec3<Real> to_end = end - apex;
        const Real b[] = {to_begin.x, to_begin.y, to_begin.z};
        const Real e[] = {to_end.x, to_end.y, to_end.z};
        for (int k = 0; k < 3; ++k) extent_[k] = hull(b[k], e[k]);
        absolute_normal_ = {std::fabs(normal_.x), std::fabs(normal_.y), std::fabs(normal_.z)};
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            // The cross product of coordinate axis k and an edge.
            const auto axis = [&](Real edge_i, Real edge_j) {
                return Axis{-edge_j, edge_i,
                            hull(edge_i * b[j] - edge_j * b[i], edge_i * e[j] - edge_j * e[i])};
            };
            axis_[k][0] = axis(b[i], b[j]);
            axis_[k][1] = axis(e[i], e[j]);
            axis_[k][2] = axis(e[i] - b[i], e[j] - b[j]);
        }
        const Real squared = dot(normal_, normal_);
        const Real inverse = squared > 0 ? 1 / squared : 0;
        along_begin_ = inverse * cross(to_end, normal_);
        along_end_ = inverse * cross(normal_, to_begin);
    }

    /// Whether the triangle overlaps a box; 13 axes may separate them.
    /// \param centre, half of the box [m].
    bool overlaps(const Vec3<Real>& centre, const Vec3<Real>& half) const noexcept {
        const Real apex[] = {apex_.x - centre.x, apex_.y - centre.y, apex_.z - centre.z};
        const Real h[] = {half.x, half.y, half.z};
        for (int k = 0; k < 3; ++k)
            if (apex[k] + extent_[k].begin > h[k] || apex[k] + extent_[k].end < -h[k]) return false;
        if (std::fabs(dot(normal_, apex_ - centre)) > dot(absolute_normal_, half)) return false;
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            for (const Axis& axis : axis_[k]) {
                const Real along = axis.i * apex[i] + axis.j * apex[j];
                const Real reach = h[i] * std::fabs(axis.i) + h[j] * std::fabs(axis.j);
                if (along + axis.extent.begin > reach || along + axis.extent.end < -reach) return false;
            }
        }
        return true;
    }

    /// What an occluder hides of the line, as shares of its length in [0, 1]; begin >= end if nothing. Occluders in the plane
    /// of the triangle hide nothing.
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
        if (!clip(ends[0], ends[1], kSmallestDepth, Real(1)) ||
            !clip(ends[0], ends[1], -kShadowEnd<Real>, Real(-1)))
            return nothing;
        const Real t0 = ends[0].along / ends[0].depth;
        const Real t1 = ends[1].along / ends[1].depth;
        return {std::clamp(std::min(t0, t1), Real(0), Real(1)),
                std::clamp(std::max(t0, t1), Real(0), Real(1))};
    }

private:
    /// Occluders count from this share of the way to the light on, so that the quotients above stay bounded, and up to
    /// kShadowEnd, as for shadow rays.
    static constexpr Real kSmallestDepth = Real(1e-6);

    /// An axis in a coordinate plane, and the projection of the triangle to it, relative to the apex.
    struct Axis {
        Real i, j;
        Interval<Real> extent;
    };

    /// The smallest interval with 0 and two numbers.
    static Interval<Real> hull(Real a, Real b) noexcept {
        return {std::min({Real(0), a, b}), std::max({Real(0), a, b})};
    }

    /// A point in the plane: its depth is 0 at the apex and 1 on the line, where `along` goes from 0 to 1.
    struct Point {
        Real along, depth;
    };

    Point in_plane(const Vec3<Real>& p) const noexcept {
        const Real end = dot(along_end_, p);
        return {end, dot(along_begin_, p) + end};
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

    Vec3<Real> apex_, normal_, absolute_normal_;
    Vec3<Real> along_begin_,
        along_end_;            ///< coordinates of a point in the plane by its dot products with these
    Interval<Real> extent_[3]; ///< of the triangle along the coordinate axes, relative to the apex
    Axis axis_[3][3];
};

NUSSELT_NAMESPACE_END
