#pragma once
/// Splits planar outlines into triangles and convex polygons, once per light. This is host code: unlike the rest of the
/// library it allocates memory, so nusselt.h leaves it out.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN

/// Indices of three vertices of an outline.
using OutlineTriangle = std::array<std::size_t, 3>;

namespace detail {

/// Twice the area of a triangle, positive if it is counter-clockwise.
inline double signed_area(const Vec2<double>& a, const Vec2<double>& b, const Vec2<double>& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// An outline in the plane of two coordinates, where it is counter-clockwise.
struct FlatOutline {
    std::vector<Vec2<double>> corners;
    bool has_area;

    /// Drops the coordinate that keeps most of the area.
    template <class Real>
    FlatOutline(const Vec3<Real>* vertices, std::size_t count);

    std::size_t size() const { return corners.size(); }
    /// Positive if the outline turns left from a over b to c.
    double turn(std::size_t a, std::size_t b, std::size_t c) const {
        return signed_area(corners[a], corners[b], corners[c]);
    }
    bool is_strictly_convex() const;
    /// The outline of some of the corners.
    FlatOutline without_others(const std::vector<std::size_t>& indices) const {
        FlatOutline result{*this};
        for (std::size_t i = 0; i < indices.size(); ++i) result.corners[i] = corners[indices[i]];
        result.corners.resize(indices.size());
        return result;
    }
};

template <class Real>
FlatOutline::FlatOutline(const Vec3<Real>* vertices, std::size_t count) {
    Vec3<double> normal{0, 0, 0};
    const auto offset = [&](std::size_t i) {
        return broadcast<double>(vertices[i]) - broadcast<double>(vertices[0]);
    };
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const Vec3<double> a = offset(i), b = offset(i + 1);
        normal += Vec3<double>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
    has_area = x > 0 || y > 0 || z > 0;
    corners.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3<double> p = broadcast<double>(vertices[i]);
        if (z >= x && z >= y)
            corners.push_back(normal.z >= 0 ? Vec2<double>{p.x, p.y} : Vec2<double>{p.y, p.x});
        else if (y >= x)
            corners.push_back(normal.y >= 0 ? Vec2<double>{p.z, p.x} : Vec2<double>{p.x, p.z});
        else
            corners.push_back(normal.x >= 0 ? Vec2<double>{p.y, p.z} : Vec2<double>{p.z, p.y});
    }
}

inline bool FlatOutline::is_strictly_convex() const {
    const std::size_t n = size();
    for (std::size_t i = 0; i < n; ++i)
        if (!(turn(i, (i + 1) % n, (i + 2) % n) > 0)) return false;
    // Stars turn left everywhere, too, but seen from the first corner the others do not follow within half a turn.
    for (std::size_t i = 1; i + 1 < n; ++i)
        if (!(turn(0, i, i + 1) > 0 && turn(0, 1, i + 1) > 0)) return false;
    return true;
}

/// Cuts an outline into triangles, ear by ear.
class EarClipper {
public:
    explicit EarClipper(const FlatOutline& outline) : outline_(outline) {
        const std::size_t n = outline.size();
        for (std::size_t i = 0; i < n; ++i) {
            previous_.push_back((i + n - 1) % n);
            next_.push_back((i + 1) % n);
        }
        for (std::size_t i = 0; i < n; ++i) is_ear_.push_back(is_ear(i));
    }

    std::vector<OutlineTriangle> run() {
        std::vector<OutlineTriangle> triangles;
        std::size_t position = 0;
        while (triangles.size() + 2 < outline_.size()) {
            const std::size_t ear = find_ear(position);
            const std::size_t before = previous_[ear], after = next_[ear];
            triangles.push_back({before, ear, after});
            next_[before] = after;
            previous_[after] = before;
            is_ear_[before] = is_ear(before);
            is_ear_[after] = is_ear(after);
            position = after;
        }
        return triangles;
    }

private:
    /// Whether the outline leaves the diagonal free that cuts off a corner.
    bool is_ear(std::size_t i) const {
        const std::size_t before = previous_[i], after = next_[i];
        if (!(outline_.turn(before, i, after) > 0)) return false;
        const auto coincide = [&](std::size_t j, std::size_t k) {
            return outline_.corners[j].x == outline_.corners[k].x &&
                   outline_.corners[j].y == outline_.corners[k].y;
        };
        for (std::size_t j = next_[after]; j != before; j = next_[j]) {
            // Outlines around holes run through the same points twice.
            if (coincide(j, before) || coincide(j, i) || coincide(j, after)) continue;
            if (outline_.turn(before, i, j) >= 0 && outline_.turn(i, after, j) >= 0 &&
                outline_.turn(after, before, j) >= 0)
                return false;
        }
        return true;
    }

    /// Outlines that intersect themselves may have none: then any corner does.
    std::size_t find_ear(std::size_t begin) const {
        std::size_t i = begin;
        do {
            if (is_ear_[i]) return i;
            i = next_[i];
        } while (i != begin);
        return begin;
    }

    const FlatOutline& outline_;
    std::vector<std::size_t> previous_, next_; ///< of what is left of the outline
    std::vector<bool> is_ear_;
};

inline std::vector<OutlineTriangle> triangulate(const FlatOutline& outline) {
    if (outline.size() > 3 && outline.has_area && !outline.is_strictly_convex())
        return EarClipper(outline).run();
    std::vector<OutlineTriangle> fan;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) fan.push_back({0, i, i + 1});
    return fan;
}

/// Joins convex parts of an outline along their common edges.
class ConvexParts {
public:
    /// Corners on straight sides stay in a part, since its neighbours need them.
    using Part = std::vector<std::size_t>;

    /// \param rounding of coordinates [m]. A turn counts as straight if rounding could have caused it.
    ConvexParts(const FlatOutline& outline, double rounding) : outline_(outline), rounding_(rounding) {
        Part whole(outline.size());
        std::iota(whole.begin(), whole.end(), std::size_t{0});
        const Part corners = corners_of(whole);
        const FlatOutline simplified = outline.without_others(corners);
        if (simplified.is_strictly_convex()) {
            // A cut through a vertex on a straight side would need more parts.
            add(simplified, corners);
        } else {
            add(outline, whole);
        }
    }

    /// \param limit for the corners of a part, without those on straight sides.
    void join(std::size_t limit) {
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            for (std::size_t j = i + 1; j < parts_.size();) {
                Part joined = joined_at_an_edge(parts_[i], parts_[j]);
                if (joined.empty() || corners_of(joined).size() > limit) {
                    ++j;
                    continue;
                }
                parts_[i] = std::move(joined);
                parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(j));
                j = i + 1;
            }
        }
    }

    const std::vector<Part>& parts() const { return parts_; }

    /// Without repeated ones and those on straight sides.
    Part corners_of(Part part) const {
        for (std::size_t kept = 0; kept < part.size();) {
            const std::size_t n = part.size();
            if (side(part[(kept + n - 1) % n], part[kept], part[(kept + 1) % n]) != 0) {
                ++kept;
            } else {
                // The one before may be straight now.
                part.erase(part.begin() + static_cast<std::ptrdiff_t>(kept));
                if (kept > 0) --kept;
            }
        }
        return part;
    }

private:
    /// \param indices of the corners of the outline.
    void add(const FlatOutline& outline, const Part& indices) {
        for (const OutlineTriangle& t : triangulate(outline))
            if (outline.turn(t[0], t[1], t[2]) > 0)
                parts_.push_back({indices[t[0]], indices[t[1]], indices[t[2]]});
    }

    /// 1 if the outline turns left from a over b to c, -1 if it turns right, 0 if it is straight up to rounding.
    int side(std::size_t a, std::size_t b, std::size_t c) const {
        const auto reach = [&](std::size_t from, std::size_t to) {
            const Vec2<double> offset = outline_.corners[to] - outline_.corners[from];
            return std::fabs(offset.x) + std::fabs(offset.y);
        };
        const double turn = outline_.turn(a, b, c);
        if (std::fabs(turn) <= rounding_ * (reach(a, b) + reach(b, c))) return 0;
        return turn > 0 ? 1 : -1;
    }

    /// Empty if the parts have no edge in common or if they are not convex together.
    Part joined_at_an_edge(const Part& a, const Part& b) const {
        const std::size_t n = a.size(), m = b.size();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < m; ++j) {
                const std::size_t start = a[i], end = a[(i + 1) % n];
                if (start != b[(j + 1) % m] || end != b[j]) continue;
                if (side(a[(i + n - 1) % n], start, b[(j + 2) % m]) < 0 ||
                    side(b[(j + m - 1) % m], end, a[(i + 2) % n]) < 0)
                    return {};
                Part joined;
                for (std::size_t k = 0; k < n; ++k) joined.push_back(a[(i + 1 + k) % n]);
                for (std::size_t k = 2; k < m; ++k) joined.push_back(b[(j + k) % m]);
                return joined;
            }
        }
        return {};
    }

    const FlatOutline& outline_;
    double rounding_;
    std::vector<Part> parts_;
};

} // namespace detail

/// Whether a planar outline is convex and has neither repeated nor collinear vertices.
/// \param vertices of the outline, in either winding.
template <class Real>
bool is_strictly_convex(const Vec3<Real>* vertices, std::size_t count) {
    return detail::FlatOutline(vertices, count).is_strictly_convex();
}

/// Splits an outline into count - 2 triangles with its winding; those at repeated and collinear vertices may have no
/// area. Strictly convex outlines become a fan around the first vertex, others are cut ear by ear, in a time that grows
/// with the square of their number of vertices.
/// \param vertices of a simple polygon, planar up to rounding, in either winding. A hole is part of the outline if two
///                 edges along the same line lead to it and back. Outlines that intersect themselves or contain
///                 numbers that are not finite give triangles that mean nothing.
/// \param count    how many there are; no triangles below 3.
template <class Real>
std::vector<OutlineTriangle> triangulate(const Vec3<Real>* vertices, std::size_t count) {
    return detail::triangulate(detail::FlatOutline(vertices, count));
}

/// Splits an outline, which may be concave, into convex polygons with its winding: few, but not always the fewest. They
/// cover the outline without overlap; vertices on straight sides drop out. It takes a time that grows with the square of
/// the number of vertices.
/// \tparam N       bound on the vertices of each part, at least 3; more give fewer parts.
/// \tparam Real    float, double or long double.
/// \param vertices of a simple polygon, as for triangulate() [m]. If it intersects itself, the parts are convex, but they
///                 may overlap or leave gaps.
/// \param count    how many there are.
/// \returns no parts if there are fewer than 3 vertices or the outline has no area.
template <int N, class Real>
std::vector<ConvexPolygon<Real, N>> split_convex(const Vec3<Real>* vertices, std::size_t count) {
    double extent = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3<double> p = broadcast<double>(vertices[i]);
        extent = std::max({extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    const detail::FlatOutline outline(vertices, count);
    // Turns are computed in double.
    constexpr double kRounding = 4 * std::max(static_cast<double>(std::numeric_limits<Real>::epsilon()),
                                              std::numeric_limits<double>::epsilon());
    detail::ConvexParts parts(outline, kRounding * extent);
    parts.join(N);
    std::vector<ConvexPolygon<Real, N>> result;
    for (const detail::ConvexParts::Part& part : parts.parts()) {
        Vec3<Real> corners[N];
        int used = 0;
        for (const std::size_t i : parts.corners_of(part)) corners[used++] = vertices[i];
        if (used >= 3) result.push_back(make_polygon<N>(corners, used));
    }
    return result;
}

NUSSELT_NAMESPACE_END
