#pragma once
/// The cells of a window: equal steps in alpha and beta, which are rectangles of unequal size in the plane of slopes.

#include <nusselt/emission/cell_lattice.h>
#include <nusselt/emission/table_window.h>

NUSSELT_NAMESPACE_BEGIN

/// An interval of slopes, as offsets from the slope in it that is next to zero: there, offsets are as precise as angles
/// need them, and intervals that are small and far away keep their digits.
template <class T>
struct SlopeInterval {
    T origin;    ///< slope
    T low, high; ///< offsets, low <= 0 <= high unless it is empty
    T move;      ///< of the origin, from that of the interval that this one is a part of

    NUSSELT_HD bool is_empty() const noexcept { return !(low < high); }

    /// The part between two slopes.
    NUSSELT_HD SlopeInterval cut(const T& from, const T& to) const noexcept {
        const T begin = max(low, from - origin);
        const T end = min(high, to - origin);
        const T by = max(min(T(0), end), begin);
        return {origin + by, begin - by, end - by, by};
    }
    /// The angle between the origin and an offset [rad].
    NUSSELT_HD T angle_at(const T& offset) const noexcept {
        // Offsets have the sign of the origin, so that nothing cancels.
        const T x = max(multiply_add(origin, origin + offset, T(1)), T(0));
        return copysign(atan2_positive(abs(offset), x), offset);
    }
    /// What angle_at() undoes.
    NUSSELT_HD T offset_at(const T& angle) const noexcept {
        const SinCos<T> turn = sincos_quarter_turn(min(abs(angle), T(kPi<T> / 2)));
        const T sine = copysign(turn.sin, angle);
        const T x = turn.cos - origin * sine;
        const T offset = multiply_add(origin, origin, T(1)) * sine / max(x, std::numeric_limits<T>::min());
        return min(max(offset, low), high);
    }
};

/// The lines of cells along one direction.
template <class T, int n>
struct WindowLines {
    SlopeInterval<T> slopes;
    TableAxis<T> axis;
    T offset[n + 1];       ///< of slopes
    T position[n + 1];     ///< in texels
    int texel[n + 1];      ///< of the position
    T share_before[n + 1]; ///< the share of this texel before the position

    /// Uninitialised: to be assigned to before it is used.
    WindowLines() = default;

    /// \param count of texels.
    /// \param angle_low where they begin, texel_size how large they are [rad].
    NUSSELT_HD WindowLines(const SlopeInterval<T>& interval, int count, const T& angle_low,
                           const T& texel_size) noexcept
        : slopes(interval), axis(axis_of(interval, count, angle_low, texel_size)), texel_size_(texel_size) {
        const T low = slopes.angle_at(slopes.low);
        const T high = slopes.angle_at(slopes.high);
        const T inverse = T(1) / texel_size;
        for (int i = 0; i <= n; ++i) {
            const T angle = low + (static_cast<T>(i) / T(n)) * (high - low);
            const T before = i > 0 ? offset[i - 1] : slopes.low;
            offset[i] = i == 0 ? slopes.low : i == n ? slopes.high : max(slopes.offset_at(angle), before);
            position[i] = inverse * (i == n ? high : angle);
            texel[i] = axis.texel_at(position[i]);
            share_before[i] = axis.before(texel[i], position[i]);
        }
    }

    NUSSELT_HD static TableAxis<T> axis_of(const SlopeInterval<T>& interval, int count, const T& angle_low,
                                           const T& texel_size) noexcept {
        const T angle = copysign(atan2_positive(abs(interval.origin), T(1)), interval.origin);
        return TableAxis<T>(count, (angle - angle_low) / texel_size);
    }

    /// The cell with an offset of slopes.
    NUSSELT_HD int cell_at(const T& x) const noexcept {
        int found = 0;
        for (int step = n / 2; step > 0; step /= 2) found += offset[found + step] <= x ? step : 0;
        return found;
    }
    NUSSELT_HD T offset_at(const T& texels) const noexcept { return slopes.offset_at(texels * texel_size_); }
    NUSSELT_HD T position_at(const T& x) const noexcept { return slopes.angle_at(x) / texel_size_; }
    /// Texels of a cell.
    NUSSELT_HD TexelInterval<T> interval(int cell) const noexcept {
        return axis.interval(position[cell], position[cell + 1]);
    }

private:
    T texel_size_;
};

/// Projected solid angles of cells whose lines are not equally spaced. As CellLattice, but cells that the horizon or the
/// outline cut are left to the caller, and far lights are those in slopes.
/// \tparam n columns and rows, 4 or 8.
template <class T, int n>
class WindowLattice {
    using Lanes = detail::CellLanes<T>;
    using L = typename Lanes::Type;
    static constexpr int kPerRow = Lanes::kCount > n ? Lanes::kCount : n; // sides of a line, with idle lanes
    static constexpr int kLines = (2 * (n + 1) + Lanes::kCount - 1) / Lanes::kCount * Lanes::kCount;

public:
    /// \param plane with coordinates of the order of its distance, in shading space or in the cosine space of a lobe.
    /// \param x, y  n + 1 increasing coordinates of lines.
    NUSSELT_HD WindowLattice(const TexturePlane<T>& plane, const T* x, const T* y) noexcept
        : plane_(plane), x_(x), y_(y) {}

    /// Projected solid angles [sr] of all cells, n * n at j * n + i, as if the horizon cut none of them. They are not zero, but
    /// at least as large as their rounding errors.
    NUSSELT_HD void find_angles(T* angle) const noexcept {
        const Vec2<T> low{x_[0], y_[0]};
        const Vec2<T> high{x_[n], y_[n]};
        const T distance = plane_distance(rectangle_in(plane_, low, high));
        const Vec3<T> centre = plane_.point_at(T(0.5) * (low + high));
        const T size = length(plane_.side_x) * (high.x - low.x) + length(plane_.side_y) * (high.y - low.y);
        constexpr T kFar = CellLattice<T, 8>::kFarIfCut;
        if (distance == T(0))
            for (int cell = 0; cell < n * n; ++cell) angle[cell] = T(0);
        else if (size * size < kFar * kFar * dot(centre, centre))
            find_far_angles(distance, angle);
        else
            find_near_angles(copysign(T(1), distance), angle);
    }

private:
    /// The cosine at the centre of each cell.
    NUSSELT_HD void find_far_angles(const T& distance, T* angle) const noexcept {
        const T scale = abs(distance) * plane_.area();
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const Vec2<T> size{x_[i + 1] - x_[i], y_[j + 1] - y_[j]};
                const Vec3<T> p = plane_.point_at({x_[i] + T(0.5) * size.x, y_[j] + T(0.5) * size.y});
                const T squared = dot(p, p);
                angle[j * n + i] = scale * size.x * size.y * (max(p.z, T(0)) / squared) / squared;
            }
        }
    }

    NUSSELT_HD void find_near_angles(const T& sign, T* angle) const noexcept {
        const T length_x = length(plane_.side_x);
        const T length_y = length(plane_.side_y);
        const Vec3<T> direction_x = normalize(plane_.side_x);
        const Vec3<T> direction_y = normalize(plane_.side_y);

        // All lines as lanes: n + 1 along y, then n + 1 along x. No horizon and no outline clips them.
        T q[3][kLines], d[3][kLines];
        for (int k = 0; k < kLines; ++k) {
            const bool is_column = k <= n;
            const int row = k - (n + 1) < n ? k - (n + 1) : n;
            const Vec3<T> begin =
                is_column ? plane_.point_at({x_[k], T(0)}) : plane_.point_at({T(0), y_[row]});
            const Vec3<T> along = is_column ? direction_y : direction_x;
            q[0][k] = begin.x, q[1][k] = begin.y, q[2][k] = begin.z;
            d[0][k] = along.x, d[1][k] = along.y, d[2][k] = along.z;
        }
        T cosine[kLines], inverse[kLines], foot[kLines];
        for (int k = 0; k < kLines; k += Lanes::kCount) {
            const auto at = [&](const T(&v)[3][kLines]) {
                return Vec3<L>{Lanes::load(v[0] + k), Lanes::load(v[1] + k), Lanes::load(v[2] + k)};
            };
            const detail::TermLine<L> line(at(q), at(d), L(T(0)), L(T(0)));
            Lanes::store(cosine + k, line.cosine);
            Lanes::store(inverse + k, line.inverse);
            Lanes::store(foot + k, line.foot);
        }

        // Terms of the sides along each line.
        T along_x[kPerRow + 1], along_y[kPerRow + 1];
        for (int i = 0; i <= kPerRow; ++i) {
            along_x[i] = length_x * x_[i < n ? i : n];
            along_y[i] = length_y * y_[i < n ? i : n];
        }
        T column[n + 1][kPerRow], row[n + 1][kPerRow];
        const auto find_terms = [&](int k, const T* position, T* term) {
            const L low(position[0]), high(position[n]);
            const detail::TermLine<L> line(L(cosine[k]), L(inverse[k]), L(foot[k]), low, high);
            for (int i = 0; i < n; i += Lanes::kCount)
                Lanes::store(term + i, line.term(Lanes::load(position + i), Lanes::load(position + i + 1)));
        };
        for (int k = 0; k <= n; ++k) {
            find_terms(k, along_y, column[k]);
            find_terms(n + 1 + k, along_x, row[k]);
        }

        constexpr T kRounding = 8 * std::numeric_limits<T>::epsilon();
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const T left = column[i][j], right = column[i + 1][j];
                const T bottom = row[j][i], top = row[j + 1][i];
                const T least = kRounding * ((abs(left) + abs(right)) + (abs(bottom) + abs(top)));
                angle[j * n + i] = T(0.5) * max(sign * ((right - left) - (top - bottom)), least);
            }
        }
    }

    const TexturePlane<T>& plane_;
    const T* x_;
    const T* y_;
};

NUSSELT_NAMESPACE_END
