#pragma once
/// Projected solid angles of all cells of a lattice in the plane of a light.
///
/// Lambert's formula is a sum over the sides of a polygon. Those of cells lie on the 2 (n + 1) lines of the lattice, so that
/// all that takes roots and divisions is per line. Each side is shared by two cells, and one arctangent per side remains.
/// The line's part above the horizon and inside of the light is an interval: sides are clipped to it. What closes the cells
/// that the horizon or the outline of the light cut are pieces of these lines, with one arctangent each.

#include <nusselt/emission/cell_lanes.h>
#include <nusselt/emission/lane_index.h>
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
template <class Real, int n>
class LatticeHorizon {
    using Lanes = CellLanes<Real>;
    using L = typename Lanes::Type;
    using T = scalar_t<Real>;

public:
    /// Uninitialised: to be assigned to before it is used.
    LatticeHorizon() = default;

    /// \param plane that the horizon cuts between corners of the texture. Other lanes of a pack mean nothing.
    NUSSELT_HD LatticeHorizon(const TexturePlane<Real>& plane, const TextureOutline<T>& outline) noexcept {
        const Real zero = Real(0);
        const Real rise_x = plane.side_x.z;
        const Real rise_y = plane.side_y.z;
        height_ = plane.corner.z;
        slope_ = {rise_x, rise_y};
        to_lowest_ = (min(rise_x, zero) + min(rise_y, zero)) / Real(n);
        to_highest_ = (max(rise_x, zero) + max(rise_y, zero)) / Real(n);

        // A point of the line and its direction, in texture coordinates. Upwards is on its left.
        const Real scale = Real(1) / max(max(abs(rise_x), abs(rise_y)), Real(kTiny<T>));
        const Vec2<Real> step{scale * rise_y, -scale * rise_x};
        const auto across = abs(rise_x) > abs(rise_y);
        const Real steepest = select(across, rise_x, rise_y);
        const Real middle = -(height_ + Real(0.5) * select(across, rise_y, rise_x)) /
                            select(steepest != zero, steepest, Real(1));
        begin_ = {select(across, middle, Real(0.5)), select(across, Real(0.5), middle)};
        constexpr T kLeast = power_of_two<T>(-60);
        inverse_ = {Real(1) / copysign(max(abs(step.x), Real(kLeast)), step.x),
                    Real(1) / copysign(max(abs(step.y), Real(kLeast)), step.y)};

        // The part inside of the outline.
        Real from = Real(-4), to = Real(4);
        for (int k = 0; k < outline.count; ++k) {
            const Vec2<Real> vertex = broadcast<Real>(outline.vertex[k]);
            const Vec2<Real> along = broadcast<Real>(outline.end_of(k) - outline.vertex[k]);
            const Real inside = det(along, begin_ - vertex);
            const Real slope = det(along, step);
            const auto enters = slope > zero;
            const auto leaves = slope < zero;
            const Real crossing = -inside / select(enters | leaves, slope, Real(1));
            from = select(enters, max(from, crossing), from);
            to = select(leaves, min(to, crossing), select(enters | (inside >= zero), to, from));
        }
        const Vec3<Real> q = plane.point_at(begin_);
        const Vec3<Real> direction = plane.offset_of(step);
        length_ = sqrt(dot(xy(direction), xy(direction)));
        const Real inverse = select(length_ > zero, Real(1) / length_, zero);
        line_ = broadcast<L>(TermLine<Real>({q.x, q.y, zero},
                                            {inverse * direction.x, inverse * direction.y, zero},
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
        const Real bottom = (Real(TexturedLight<T, n>::line(row)) - begin_.y) * inverse_.y;
        const Real top = (Real(TexturedLight<T, n>::line(row + 1)) - begin_.y) * inverse_.y;
        const L from = max(min(left, right), L(min(bottom, top)));
        const L to = max(min(max(left, right), L(max(bottom, top))), from);
        return sum + select(cut, line_.term(L(length_) * from, L(length_) * to), L(T(0)));
    }

private:
    /// Heights of the corners of cells with the least texture coordinates.
    NUSSELT_INLINE L heights(int column, int row) const noexcept {
        const L x = L(T(1) / T(n)) * Lanes::count_from(column);
        return multiply_add(x, L(slope_.x), L(height_ + Real(TexturedLight<T, n>::line(row)) * slope_.y));
    }

    Real height_;                 ///< of the corner (0, 0)
    Vec2<Real> slope_;            ///< rise along the sides of the texture
    Real to_lowest_, to_highest_; ///< rise in a cell
    // In texture coordinates: position 0 of the line, and the reciprocals of its direction.
    Vec2<Real> begin_, inverse_;
    Real length_; ///< of a step [m]
    TermLine<L> line_;
};

} // namespace detail

/// \tparam Real float, double, long double, or a pack with a shading point per lane.
/// \tparam n    columns and rows, 8 or 16.
template <class Real, int n>
class CellLattice {
    using Lanes = detail::CellLanes<Real>;
    using L = typename Lanes::Type;
    using T = scalar_t<Real>;
    using Line = detail::TermLine<Real>;
    static constexpr int kLanes = Lanes::kCount;
    static constexpr int kPoints = Lanes::kPoints;

public:
    /// Lights whose sides add up to less than this times their distance are far: Lambert's formula loses digits with the
    /// distance, while the cosine over a cell becomes as good as quadratic. Both errors are alike here.
    static constexpr T kFar = power_of_two<T>((24 - std::numeric_limits<T>::digits) / 6);
    /// The same for lights that the horizon or their outline cuts. Only a mean height is known of cells that are cut.
    static constexpr T kFarIfCut = power_of_two<T>(-std::numeric_limits<T>::digits / 5);

    /// \param plane of the light in shading space, or in the cosine space of a lobe, with coordinates of order one.
    NUSSELT_HD CellLattice(const TexturePlane<Real>& plane, const TexturedLight<T, n>& light) noexcept
        : plane_(plane), light_(light) {
        length_x_ = length(plane.side_x);
        length_y_ = length(plane.side_y);
        direction_x_ = normalize(plane.side_x);
        direction_y_ = normalize(plane.side_y);
        // The triple product of the corner and the sides tells which way around the sides of cells go.
        const ConvexPolygon<Real, 4> texture =
            rectangle_in<Real>(plane, {Real(0), Real(0)}, {Real(1), Real(1)});
        signed_distance_ = plane_distance(texture);
        lowest_ = highest_ = plane.corner.z;
        for (const Vec3<Real>& v : texture.vertex) {
            lowest_ = min(lowest_, v.z);
            highest_ = max(highest_, v.z);
        }
    }

    /// Distance of the plane of the light from the origin [m], with the sign of plane_distance(); 0 if nothing can be seen.
    NUSSELT_HD Real signed_distance() const noexcept { return signed_distance_; }

    /// Projected solid angles [sr] of the parts of all cells that are above the horizon and inside of the light. They are
    /// never zero where the light is: at least as large as their rounding errors.
    /// \param angle n * n of them, in the order of cells; those of all lanes of a pack together.
    NUSSELT_HD void find_angles(T* angle) const noexcept {
        const Vec3<Real> centre = plane_.point_at({Real(0.5), Real(0.5)});
        const Real size = length_x_ + length_y_;
        const mask_t<Real> seen = (signed_distance_ != Real(0)) & (highest_ > Real(0));
        const Real squared = size * size;
        mask_t<Real> far = squared < Real(kFarIfCut * kFarIfCut) * dot(centre, centre);
        if (light_.pieces == 0)
            far |= (lowest_ >= Real(0)) & (squared < Real(kFar * kFar) * dot(centre, centre));
        far &= seen;
        const mask_t<Real> near = seen & !far;
        if (any(near))
            find_near_angles(angle, near);
        else
            for (int cell = 0; cell < n * n; cell += kLanes) Lanes::store(angle + kPoints * cell, L(T(0)));
        if (any(far)) find_far_angles(angle, far);
    }

private:
    static constexpr T line(int i) noexcept { return TexturedLight<T, n>::line(i); }

    /// The Taylor series of the cosine around the centre up to the second order, and the mean height over the corners and the
    /// centre for cells that the horizon cuts.
    /// \param points whose angles change.
    NUSSELT_HD void find_far_angles(T* angle, const mask_t<Real>& points) const noexcept {
        constexpr T step = T(1) / T(n);
        const Real rise_x = Real(T(0.5) * step) * plane_.side_x.z;
        const Real rise_y = Real(T(0.5) * step) * plane_.side_y.z;
        const Real area = abs(signed_distance_) * Real(step) * Real(step) *
                          length(cross(direction_x_, direction_y_)) * length_x_ * length_y_;
        // Sides of a cell.
        const Vec3<Real> a = Real(step) * plane_.side_x;
        const Vec3<Real> b = Real(step) * plane_.side_y;
        const Real spread = Real(T(1) / T(6)) * (dot(a, a) + dot(b, b));
        const auto along = [](const Vec3<L>& p, const Vec3<Real>& side) {
            return multiply_add(p.x, L(side.x), multiply_add(p.y, L(side.y), p.z * L(side.z)));
        };
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; column += kLanes) {
                const L x = L(step) * (Lanes::count_from(column) + L(T(0.5)));
                const Real y = Real(step * (static_cast<T>(row) + T(0.5)));
                const auto at = [&](const Real& corner, const Real& side_x, const Real& side_y) {
                    return multiply_add(x, L(side_x), L(multiply_add(y, side_y, corner)));
                };
                const Vec3<L> p{at(plane_.corner.x, plane_.side_x.x, plane_.side_y.x),
                                at(plane_.corner.y, plane_.side_x.y, plane_.side_y.y),
                                at(plane_.corner.z, plane_.side_x.z, plane_.side_y.z)};
                const L inverse = L(T(1)) / dot(p, p);
                const auto above = [&](const Real& rise) { return max(p.z + L(rise), L(T(0))); };
                const L corners = (above(rise_x + rise_y) + above(rise_x - rise_y)) +
                                  (above(rise_y - rise_x) + above(-rise_x - rise_y));
                const L height = L(T(2) / T(3)) * max(p.z, L(T(0))) + L(T(1) / T(12)) * corners;
                const L along_a = along(p, a), along_b = along(p, b);
                const L growth = multiply_add(
                    inverse, (along_a * along_a + along_b * along_b) * inverse - L(spread), L(T(1)));
                const L fall = (L(a.z) * along_a + L(b.z) * along_b) * (inverse * L(T(1) / T(3)));
                // Where the horizon cuts a cell, the series is wrong.
                const L mean = min(max(height * growth - fall, L(T(0.5)) * height), L(T(2)) * height);
                const int cell = row * n + column;
                const L cover = Lanes::load_shared(light_.cover + cell);
                T* const target = angle + kPoints * cell;
                Lanes::store(target, select(mask_t<L>(points), (L(area) * cover) * (mean * inverse) * inverse,
                                            Lanes::load(target)));
            }
        }
    }

    /// \param points whose angles are not zero.
    NUSSELT_HD void find_near_angles(T* angle, const mask_t<Real>& points) const noexcept {
        alignas(Real) T outline_terms[kPoints * n * n];
        const bool has_pieces = light_.pieces > 0;
        if (has_pieces) add_outline(outline_terms);

        // Prepare all lines of the lattice as lanes.
        const Lines columns(plane_.corner, plane_.side_x, direction_y_, length_y_, light_.column_line);
        const Lines rows(plane_.corner, plane_.side_y, direction_x_, length_x_, light_.row_line);

        const mask_t<Real> cut = points & !(lowest_ >= Real(0));
        detail::LatticeHorizon<Real, n> horizon{};
        if (any(cut)) horizon = detail::LatticeHorizon<Real, n>(plane_, light_.outline);
        const mask_t<L> is_cut(cut);
        const mask_t<L> is_seen(points);
        const L sign = copysign(L(T(1)), L(signed_distance_));
        // Terms of the sides of a row of cells, and of the sides between columns.
        alignas(Real) T below[kPoints * n];
        alignas(Real) T above[kPoints * n];
        alignas(Real) T between[n][kPoints * (n + 1)];
        sides_along(rows.line(0), length_x_, below);
        for (int column = 0; column < n; column += kLanes) {
            const detail::TermLine<L> lines = columns.lanes(column);
            for (int row = 0; row < n; ++row)
                Lanes::store(between[row] + kPoints * column,
                             lines.term(L(length_y_ * Real(line(row))), L(length_y_ * Real(line(row + 1)))));
        }
        alignas(Real) T last[kPoints * n];
        sides_along(columns.line(n), length_y_, last);
        for (int row = 0; row < n; ++row) {
            for (int k = 0; k < kPoints; ++k) between[row][kPoints * n + k] = last[kPoints * row + k];
            sides_along(rows.line(row + 1), length_x_, above);
            for (int column = 0; column < n; column += kLanes) {
                const L left = Lanes::load(between[row] + kPoints * column);
                const L right = Lanes::load(between[row] + kPoints * (column + 1));
                const L bottom = Lanes::load(below + kPoints * column);
                const L top = Lanes::load(above + kPoints * column);
                L sum = (right - left) - (top - bottom);
                if (has_pieces) sum = sum + Lanes::load(outline_terms + kPoints * (row * n + column));
                if (any(cut)) sum = select(is_cut, horizon.completed(sum, column, row), sum);
                constexpr T kRounding = 8 * std::numeric_limits<T>::epsilon();
                const L least = L(kRounding) * ((abs(left) + abs(right)) + (abs(bottom) + abs(top)));
                mask_t<L> has_part = is_seen;
                if (any(cut)) has_part = is_seen & (horizon.reaches_above(column, row) | !is_cut);
                Lanes::store(angle + kPoints * (row * n + column),
                             select(has_part, L(T(0.5)) * max(sign * sum, least), L(T(0))));
            }
            for (int column = 0; column < n; column += kLanes)
                Lanes::store(below + kPoints * column, Lanes::load(above + kPoints * column));
        }
    }

    /// Terms of the pieces of the outline.
    NUSSELT_HD void add_outline(T (&terms)[kPoints * n * n]) const noexcept {
        for (T& term : terms) term = T(0);
        int edge = -1;
        Line along{};
        Real edge_length = Real(0);
        for (int k = 0; k < light_.pieces; ++k) {
            const OutlinePiece<T>& piece = light_.piece[k];
            if (piece.edge != edge) {
                edge = piece.edge;
                const Vec2<T> begin = light_.outline.vertex[edge];
                const Vec3<Real> offset =
                    plane_.offset_of(broadcast<Real>(light_.outline.end_of(edge) - begin));
                edge_length = length(offset);
                along =
                    Line(plane_.point_at(broadcast<Real>(begin)), normalize(offset), Real(0), edge_length);
            }
            const Real term = along.term(edge_length * Real(piece.begin), edge_length * Real(piece.end));
            T added[kPoints];
            detail::store_lanes(added, term);
            for (int point = 0; point < kPoints; ++point) terms[kPoints * piece.cell + point] += added[point];
        }
    }

    /// The n + 1 lines of one direction.
    class Lines {
    public:
        /// \param step      from the first to the last line.
        /// \param direction unit.
        /// \param length    of a side of the texture along the lines.
        NUSSELT_HD Lines(const Vec3<Real>& corner, const Vec3<Real>& step, const Vec3<Real>& direction,
                         const Real& length, const LatticeChord<T> (&chord)[n + 1]) noexcept {
            const Vec3<L> along{L(direction.x), L(direction.y), L(direction.z)};
            for (int i = 0; i < n; i += kLanes) {
                const L x = L(T(1) / T(n)) * Lanes::count_from(i);
                const auto at = [&](const Real& from, const Real& to) {
                    return multiply_add(x, L(to), L(from));
                };
                T low[kLanes], high[kLanes];
                for (int k = 0; k < kLanes; ++k) {
                    low[k] = chord[i + k].low;
                    high[k] = chord[i + k].high;
                }
                const detail::TermLine<L> lines(
                    {at(corner.x, step.x), at(corner.y, step.y), at(corner.z, step.z)}, along,
                    L(length) * Lanes::load_shared(low), L(length) * Lanes::load_shared(high));
                Lanes::store(cosine_ + kPoints * i, lines.cosine);
                Lanes::store(inverse_ + kPoints * i, lines.inverse);
                Lanes::store(foot_ + kPoints * i, lines.foot);
                Lanes::store(low_ + kPoints * i, lines.low);
                Lanes::store(high_ + kPoints * i, lines.high);
            }
            last_ = Line(corner + step, direction, length * Real(chord[n].low), length * Real(chord[n].high));
        }

        /// Line i for all cells.
        NUSSELT_INLINE detail::TermLine<L> line(int i) const noexcept {
            if (i == n) return detail::broadcast<L>(last_);
            if constexpr (Lanes::kArePacks)
                return {L(cosine_[i]), L(inverse_[i]), L(foot_[i]), L(low_[i]), L(high_[i])};
            else
                return lanes(i);
        }
        /// Lines from i on, one per cell.
        NUSSELT_INLINE detail::TermLine<L> lanes(int i) const noexcept {
            const int k = kPoints * i;
            return {Lanes::load(cosine_ + k), Lanes::load(inverse_ + k), Lanes::load(foot_ + k),
                    Lanes::load(low_ + k), Lanes::load(high_ + k)};
        }

    private:
        static constexpr int kSize = kPoints * n;
        alignas(Real) T cosine_[kSize];
        alignas(Real) T inverse_[kSize];
        alignas(Real) T foot_[kSize];
        alignas(Real) T low_[kSize];
        alignas(Real) T high_[kSize];
        Line last_;
    };

    /// Terms of the n sides of cells on a line.
    NUSSELT_INLINE static void sides_along(const detail::TermLine<L>& lanes, const Real& length,
                                           T (&terms)[kPoints * n]) noexcept {
        const Real step = length / Real(n);
        for (int i = 0; i < n; i += kLanes)
            Lanes::store(terms + kPoints * i,
                         lanes.term(L(step) * Lanes::count_from(i), L(step) * Lanes::count_from(i + 1)));
    }

    const TexturePlane<Real>& plane_;
    const TexturedLight<T, n>& light_;
    Real length_x_, length_y_;
    Vec3<Real> direction_x_, direction_y_;
    Real signed_distance_;
    Real lowest_, highest_;
};

NUSSELT_NAMESPACE_END
