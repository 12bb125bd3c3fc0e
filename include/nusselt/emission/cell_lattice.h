#pragma once
/// Projected solid angles of all cells of a lattice in the plane of a light.
///
/// Lambert's formula is a sum over the sides of a polygon. Those of cells lie on the 2 (n + 1) lines of the lattice, so that
/// all that takes roots and divisions is per line. Each side is shared by two cells, and one arctangent per side remains.
/// The line's part above the horizon and inside of the light is an interval: sides are clipped to it. What closes the cells
/// that the horizon or the outline of the light cut are pieces of these lines, with one arctangent each.

#include <nusselt/emission/cell_lanes.h>
#include <nusselt/emission/texture_plane.h>
#include <nusselt/emission/textured_light.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// A line in shading space that the terms of Lambert's formula are taken along. Positions on it are distances [m].
template <class Real>
struct TermLine {
    Real cosine;    ///< between the zenith and the normal of the plane through the line and the origin
    Real inverse;   ///< reciprocal distance of the line from the origin
    Real foot;      ///< the position next to the origin
    Real low, high; ///< the interval that counts, empty if equal

    /// Uninitialised: to be assigned to before it is used.
    TermLine() = default;

    NUSSELT_INLINE TermLine(const Real& cosine_of_plane, const Real& inverse_distance,
                            const Real& foot_position, const Real& interval_low,
                            const Real& interval_high) noexcept
        : cosine(cosine_of_plane),
          inverse(inverse_distance),
          foot(foot_position),
          low(interval_low),
          high(interval_high) {}

    /// \param q         position 0.
    /// \param direction unit.
    /// \param from, to  the interval that counts before it is clipped to the horizon.
    NUSSELT_INLINE TermLine(const Vec3<Real>& q, const Vec3<Real>& direction, const Real& from,
                            const Real& to) noexcept {
        // Closer lines have a right angle or none.
        constexpr scalar_t<Real> kLeast = power_of_two<scalar_t<Real>>(-50);
        const Vec3<Real> moment = cross(q, direction);
        inverse = Real(1) / sqrt(max(dot(moment, moment), Real(kLeast * kLeast)));
        cosine = inverse * moment.z;
        foot = -dot(q, direction);
        const auto rises = direction.z > Real(0);
        const auto falls = direction.z < Real(0);
        const Real horizon = -q.z / select(rises | falls, direction.z, Real(1));
        const auto below = (!(rises | falls)) & (q.z < Real(0));
        low = select(rises, min(max(from, horizon), to), from);
        high = select(falls, max(min(to, horizon), from), select(below, from, to));
    }

    /// The angle under which a part of the line is seen, times the cosine.
    NUSSELT_INLINE Real term(const Real& begin, const Real& end) const noexcept {
        const Real a = min(max(begin, low), high);
        const Real b = min(max(end, low), high);
        const Real y = (b - a) * inverse;
        const Real x = multiply_add((a - foot) * inverse, (b - foot) * inverse, Real(1));
        // Most sides are seen under less than half of a right angle, for which less work suffices.
        if (all(y < x)) return cosine * atan_up_to_one(y / x);
        return cosine * atan2_positive(y, x);
    }
};

template <class Real, class Single>
NUSSELT_INLINE TermLine<Real> broadcast(const TermLine<Single>& line) noexcept {
    return {Real(line.cosine), Real(line.inverse), Real(line.foot), Real(line.low), Real(line.high)};
}

/// The line along which the horizon cuts a lattice. It closes the cells that it cuts.
template <class T, int n>
class LatticeHorizon {
    using Lanes = CellLanes<T>;
    using L = typename Lanes::Type;

public:
    /// Uninitialised: to be assigned to before it is used.
    LatticeHorizon() = default;

    /// \param plane that the horizon cuts between corners of the texture.
    NUSSELT_HD LatticeHorizon(const TexturePlane<T>& plane, const TextureOutline<T>& outline) noexcept {
        const T rise_x = plane.side_x.z;
        const T rise_y = plane.side_y.z;
        height_ = plane.corner.z;
        slope_ = {rise_x, rise_y};
        to_lowest_ = (min(rise_x, T(0)) + min(rise_y, T(0))) / T(n);
        to_highest_ = (max(rise_x, T(0)) + max(rise_y, T(0))) / T(n);

        // A point of the line and its direction, in texture coordinates. Upwards is on its left.
        const T scale = T(1) / max(max(abs(rise_x), abs(rise_y)), kTiny<T>);
        const Vec2<T> step{scale * rise_y, -scale * rise_x};
        const bool across = abs(rise_x) > abs(rise_y);
        const T steepest = across ? rise_x : rise_y;
        const T middle =
            -(height_ + T(0.5) * (across ? rise_y : rise_x)) / (steepest != T(0) ? steepest : T(1));
        begin_ = across ? Vec2<T>{middle, T(0.5)} : Vec2<T>{T(0.5), middle};
        constexpr T kLeast = power_of_two<T>(-60);
        inverse_ = {T(1) / copysign(max(abs(step.x), kLeast), step.x),
                    T(1) / copysign(max(abs(step.y), kLeast), step.y)};

        // The part inside of the outline.
        T from = T(-4), to = T(4);
        for (int k = 0; k < outline.count; ++k) {
            const Vec2<T> along = outline.end_of(k) - outline.vertex[k];
            const T inside = det(along, begin_ - outline.vertex[k]);
            const T slope = det(along, step);
            if (slope > T(0))
                from = max(from, -inside / slope);
            else if (slope < T(0))
                to = min(to, -inside / slope);
            else if (inside < T(0))
                to = from;
        }
        const Vec3<T> q = plane.point_at(begin_);
        const Vec3<T> direction = plane.offset_of(step);
        length_ = sqrt(dot(xy(direction), xy(direction)));
        const T inverse = length_ > T(0) ? T(1) / length_ : T(0);
        line_ =
            broadcast<L>(TermLine<T>({q.x, q.y, T(0)}, {inverse * direction.x, inverse * direction.y, T(0)},
                                     length_ * from, length_ * max(from, to)));
    }

    /// Cells of which some part is above the horizon.
    NUSSELT_INLINE mask_t<L> reaches_above(int column, int row) const noexcept {
        return heights(column, row) > L(-to_highest_);
    }

    /// The sums of cells from (column, row) on with the term of the side along the horizon.
    NUSSELT_INLINE L completed(const L& sum, int column, int row) const noexcept {
        const L z = heights(column, row);
        const auto cut = (z < L(-to_lowest_)) & (z > L(-to_highest_));
        if (!any(cut)) return sum;
        const auto position = [&](int i) {
            return (L(T(1) / T(n)) * Lanes::count_from(i) - L(begin_.x)) * L(inverse_.x);
        };
        const L left = position(column);
        const L right = position(column + 1);
        const T bottom = (TexturedLight<T, n>::line(row) - begin_.y) * inverse_.y;
        const T top = (TexturedLight<T, n>::line(row + 1) - begin_.y) * inverse_.y;
        const L from = max(min(left, right), L(min(bottom, top)));
        const L to = max(min(max(left, right), L(max(bottom, top))), from);
        return sum + select(cut, line_.term(L(length_) * from, L(length_) * to), L(T(0)));
    }

private:
    /// Heights of the corners of cells with the least texture coordinates.
    NUSSELT_INLINE L heights(int column, int row) const noexcept {
        const L x = L(T(1) / T(n)) * Lanes::count_from(column);
        return multiply_add(x, L(slope_.x), L(height_ + TexturedLight<T, n>::line(row) * slope_.y));
    }

    T height_;                 ///< of the corner (0, 0)
    Vec2<T> slope_;            ///< rise along the sides of the texture
    T to_lowest_, to_highest_; ///< rise in a cell
    // In texture coordinates: position 0 of the line, and the reciprocals of its direction.
    Vec2<T> begin_, inverse_;
    T length_; ///< of a step [m]
    TermLine<L> line_;
};

} // namespace detail

/// \tparam T float, double or long double.
/// \tparam n columns and rows, 8 or 16.
template <class T, int n>
class CellLattice {
    using Lanes = detail::CellLanes<T>;
    using L = typename Lanes::Type;
    using Line = detail::TermLine<T>;
    static constexpr int kLanes = Lanes::kCount;

public:
    /// Lights whose sides add up to less than this times their distance are far: Lambert's formula loses digits with the
    /// distance, while the cosine over a cell becomes as good as linear. Both errors are alike here.
    static constexpr T kFar = power_of_two<T>(-std::numeric_limits<T>::digits / 5);

    /// \param plane of the light in shading space, or in the cosine space of a lobe, with coordinates of order one.
    NUSSELT_HD CellLattice(const TexturePlane<T>& plane, const TexturedLight<T, n>& light) noexcept
        : plane_(plane), light_(light) {
        length_x_ = length(plane.side_x);
        length_y_ = length(plane.side_y);
        direction_x_ = normalize(plane.side_x);
        direction_y_ = normalize(plane.side_y);
        // The triple product of the corner and the sides tells which way around the sides of cells go.
        const ConvexPolygon<T, 4> texture = rectangle_in<T>(plane, {T(0), T(0)}, {T(1), T(1)});
        signed_distance_ = plane_distance(texture);
        lowest_ = highest_ = plane.corner.z;
        for (const Vec3<T>& v : texture.vertex) {
            lowest_ = min(lowest_, v.z);
            highest_ = max(highest_, v.z);
        }
    }

    /// Distance of the plane of the light from the origin [m], with the sign of plane_distance(); 0 if nothing can be seen.
    NUSSELT_HD T signed_distance() const noexcept { return signed_distance_; }

    /// Projected solid angles [sr] of the parts of all cells that are above the horizon and inside of the light. They are
    /// never zero where the light is: at least as large as their rounding errors.
    /// \param angle n * n of them, in the order of cells.
    NUSSELT_HD void find_angles(T* angle) const noexcept {
        const Vec3<T> centre = plane_.point_at({T(0.5), T(0.5)});
        const T size = length_x_ + length_y_;
        if (signed_distance_ == T(0) || !(highest_ > T(0)))
            for (int cell = 0; cell < n * n; cell += kLanes) Lanes::store(angle + cell, L(T(0)));
        else if (size * size < kFar * kFar * dot(centre, centre))
            find_far_angles(angle);
        else
            find_near_angles(angle);
    }

private:
    static constexpr T line(int i) noexcept { return TexturedLight<T, n>::line(i); }

    /// The cosine at the centre, and the mean height over the corners and the centre for cells that the horizon cuts.
    NUSSELT_HD void find_far_angles(T* angle) const noexcept {
        const T step = T(1) / T(n);
        const T rise_x = T(0.5) * step * plane_.side_x.z;
        const T rise_y = T(0.5) * step * plane_.side_y.z;
        const T area = abs(signed_distance_) * step * step * length(cross(direction_x_, direction_y_)) *
                       length_x_ * length_y_;
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; column += kLanes) {
                const L x = L(step) * (Lanes::count_from(column) + L(T(0.5)));
                const T y = step * (static_cast<T>(row) + T(0.5));
                const auto at = [&](const T& corner, const T& side_x, const T& side_y) {
                    return multiply_add(x, L(side_x), L(multiply_add(y, side_y, corner)));
                };
                const Vec3<L> p{at(plane_.corner.x, plane_.side_x.x, plane_.side_y.x),
                                at(plane_.corner.y, plane_.side_x.y, plane_.side_y.y),
                                at(plane_.corner.z, plane_.side_x.z, plane_.side_y.z)};
                const L squared = dot(p, p);
                const auto above = [&](const T& rise) { return max(p.z + L(rise), L(T(0))); };
                const L corners = (above(rise_x + rise_y) + above(rise_x - rise_y)) +
                                  (above(rise_y - rise_x) + above(-rise_x - rise_y));
                const L height = L(T(2) / T(3)) * max(p.z, L(T(0))) + L(T(1) / T(12)) * corners;
                const int cell = row * n + column;
                const L cover = Lanes::load(light_.cover + cell);
                Lanes::store(angle + cell, (L(area) * cover) * (height / squared) / squared);
            }
        }
    }

    NUSSELT_HD void find_near_angles(T* angle) const noexcept {
        T outline_terms[n * n];
        const bool has_pieces = light_.pieces > 0;
        if (has_pieces) add_outline(outline_terms);

        // Prepare all lines of the lattice as lanes.
        const Lines columns(plane_.corner, plane_.side_x, direction_y_, length_y_, light_.column_line);
        const Lines rows(plane_.corner, plane_.side_y, direction_x_, length_x_, light_.row_line);

        const bool cut = !(lowest_ >= T(0));
        detail::LatticeHorizon<T, n> horizon{};
        if (cut) horizon = detail::LatticeHorizon<T, n>(plane_, light_.outline);
        T below[n], above[n]; // terms of the sides of a row of cells
        sides_along(rows.line(0), length_x_, below);
        T last[n];
        sides_along(columns.line(n), length_y_, last);
        T between[n][n + 1]; // terms of the sides between columns
        for (int column = 0; column < n; column += kLanes) {
            const detail::TermLine<L> lines = columns.lanes(column);
            for (int row = 0; row < n; ++row)
                Lanes::store(between[row] + column,
                             lines.term(L(length_y_ * line(row)), L(length_y_ * line(row + 1))));
        }
        for (int row = 0; row < n; ++row) {
            between[row][n] = last[row];
            sides_along(rows.line(row + 1), length_x_, above);
            for (int column = 0; column < n; column += kLanes) {
                const L left = Lanes::load(between[row] + column);
                const L right = Lanes::load(between[row] + column + 1);
                const L bottom = Lanes::load(below + column);
                const L top = Lanes::load(above + column);
                L sum = (right - left) - (top - bottom);
                if (has_pieces) sum = sum + Lanes::load(outline_terms + row * n + column);
                if (cut) sum = horizon.completed(sum, column, row);
                constexpr T kRounding = 8 * std::numeric_limits<T>::epsilon();
                const L least = L(kRounding) * ((abs(left) + abs(right)) + (abs(bottom) + abs(top)));
                L half = L(T(0.5)) * max(copysign(L(T(1)), L(signed_distance_)) * sum, least);
                if (cut) half = select(horizon.reaches_above(column, row), half, L(T(0)));
                Lanes::store(angle + row * n + column, half);
            }
            for (int column = 0; column < n; column += kLanes)
                Lanes::store(below + column, Lanes::load(above + column));
        }
    }

    /// Terms of the pieces of the outline.
    NUSSELT_HD void add_outline(T (&terms)[n * n]) const noexcept {
        for (T& term : terms) term = T(0);
        int edge = -1;
        Line along{};
        T edge_length = T(0);
        for (int k = 0; k < light_.pieces; ++k) {
            const OutlinePiece<T>& piece = light_.piece[k];
            if (piece.edge != edge) {
                edge = piece.edge;
                const Vec2<T> begin = light_.outline.vertex[edge];
                const Vec3<T> offset = plane_.offset_of(light_.outline.end_of(edge) - begin);
                edge_length = length(offset);
                along = Line(plane_.point_at(begin), normalize(offset), T(0), edge_length);
            }
            terms[piece.cell] += along.term(edge_length * piece.begin, edge_length * piece.end);
        }
    }

    /// The n + 1 lines of one direction.
    class Lines {
    public:
        /// \param step      from the first to the last line.
        /// \param direction unit.
        /// \param length    of a side of the texture along the lines.
        NUSSELT_HD Lines(const Vec3<T>& corner, const Vec3<T>& step, const Vec3<T>& direction,
                         const T& length, const LatticeChord<T> (&chord)[n + 1]) noexcept {
            const Vec3<L> along{L(direction.x), L(direction.y), L(direction.z)};
            for (int i = 0; i < n; i += kLanes) {
                const L x = L(T(1) / T(n)) * Lanes::count_from(i);
                const auto at = [&](const T& from, const T& to) { return multiply_add(x, L(to), L(from)); };
                T low[kLanes], high[kLanes];
                for (int k = 0; k < kLanes; ++k) {
                    low[k] = chord[i + k].low;
                    high[k] = chord[i + k].high;
                }
                const detail::TermLine<L> lines(
                    {at(corner.x, step.x), at(corner.y, step.y), at(corner.z, step.z)}, along,
                    L(length) * Lanes::load(low), L(length) * Lanes::load(high));
                Lanes::store(cosine_ + i, lines.cosine);
                Lanes::store(inverse_ + i, lines.inverse);
                Lanes::store(foot_ + i, lines.foot);
                Lanes::store(low_ + i, lines.low);
                Lanes::store(high_ + i, lines.high);
            }
            const Line last(corner + step, direction, length * chord[n].low, length * chord[n].high);
            cosine_[n] = last.cosine;
            inverse_[n] = last.inverse;
            foot_[n] = last.foot;
            low_[n] = last.low;
            high_[n] = last.high;
        }

        /// Line i in all lanes.
        NUSSELT_INLINE detail::TermLine<L> line(int i) const noexcept {
            return {L(cosine_[i]), L(inverse_[i]), L(foot_[i]), L(low_[i]), L(high_[i])};
        }
        /// Lines from i on, one per lane.
        NUSSELT_INLINE detail::TermLine<L> lanes(int i) const noexcept {
            return {Lanes::load(cosine_ + i), Lanes::load(inverse_ + i), Lanes::load(foot_ + i),
                    Lanes::load(low_ + i), Lanes::load(high_ + i)};
        }

    private:
        T cosine_[n + 1], inverse_[n + 1], foot_[n + 1], low_[n + 1], high_[n + 1];
    };

    /// Terms of the n sides of cells on a line.
    NUSSELT_INLINE static void sides_along(const detail::TermLine<L>& lanes, const T& length,
                                           T (&terms)[n]) noexcept {
        const T step = length / T(n);
        for (int i = 0; i < n; i += kLanes)
            Lanes::store(terms + i,
                         lanes.term(L(step) * Lanes::count_from(i), L(step) * Lanes::count_from(i + 1)));
    }

    const TexturePlane<T>& plane_;
    const TexturedLight<T, n>& light_;
    T length_x_, length_y_;
    Vec3<T> direction_x_, direction_y_;
    T signed_distance_;
    T lowest_, highest_;
};

NUSSELT_NAMESPACE_END
