#pragma once
/// Windows of a rectified table: their sums, their lit part, and samples in proportion to the table.
///
/// Positions are offsets, in texels, from an origin that the caller chooses near the window. So windows far smaller than a
/// texel keep their digits. Sums over windows add up exact sums over texels with positive shares: nothing cancels.

#include <nusselt/emission/rectified_table.h>

NUSSELT_NAMESPACE_BEGIN

/// An interval of offsets, and the texels that it meets.
template <class T>
struct TexelInterval {
    T begin, end;
    int first, last; ///< texels

    /// Where sums over the interval change from one share of texels to another.
    NUSSELT_HD int edge(int k) const noexcept {
        return k == 0 ? first : k == 1 ? first + 1 : k == 2 ? (last > first ? last : first + 1) : last + 1;
    }
};

/// Offsets along alpha or beta.
template <class T>
struct TableAxis {
    int count;  ///< texels
    int texel;  ///< with the origin of offsets
    T fraction; ///< of this texel before the origin

    /// \param position of the origin in the table, in texels.
    NUSSELT_HD TableAxis(int texels, const T& position) noexcept : count(texels) {
        const T inside = min(max(position, T(0)), static_cast<T>(texels));
        texel = detail::clamp_index(detail::floor_to_int(inside), texels);
        fraction = inside - static_cast<T>(texel);
    }
    /// Uninitialised: to be assigned to before it is used.
    TableAxis() = default;

    /// Where texel i begins.
    NUSSELT_HD T edge(int i) const noexcept { return static_cast<T>(i - texel) - fraction; }
    NUSSELT_HD int texel_at(const T& offset) const noexcept {
        const T limit = static_cast<T>(2 * count);
        return detail::clamp_index(texel + detail::floor_to_int(min(max(offset + fraction, -limit), limit)),
                                   count);
    }
    NUSSELT_HD TexelInterval<T> interval(const T& begin, const T& end) const noexcept {
        const int first = texel_at(begin);
        const int last = texel_at(end);
        return {begin, end, first, last > first ? last : first};
    }
    /// The share of a texel that is before an offset.
    NUSSELT_HD T before(int i, const T& offset) const noexcept {
        return min(max(offset - edge(i), T(0)), T(1));
    }
    /// What an interval has of the texels between its edges k and k + 1: a length, or 1 for whole texels.
    NUSSELT_HD T share(const TexelInterval<T>& x, int k) const noexcept {
        if (x.last == x.first) return k == 0 ? x.end - x.begin : T(0);
        return k == 0   ? max(edge(x.first + 1) - x.begin, T(0))
               : k == 1 ? T(1)
                        : max(x.end - edge(x.last), T(0));
    }
    /// The part of an interval in a texel.
    NUSSELT_HD Vec2<T> part(const TexelInterval<T>& x, int i) const noexcept {
        const T begin = i > x.first ? edge(i) : x.begin;
        const T end = i < x.last ? edge(i + 1) : x.end;
        return {min(begin, x.end), max(end, begin)};
    }
};

/// Sums of a window over those of its table.
template <class T>
struct WindowSums {
    T weight, square, solid_angle;
};

/// A point in a window.
template <class T>
struct WindowPoint {
    int i, j;       ///< texel
    Vec2<T> offset; ///< in texels
};

/// Texels from begin to before end along alpha and beta, none if these are equal.
struct TexelRectangle {
    int begin[2], end[2];
};

namespace detail {

/// Weight and solid angle of all texels before a position, where parts of texels have their share. Differences have errors of
/// some units of the integers. The twin in GLSL, which has no double, adds up TableWindow::sums() for each cell instead.
template <class T>
struct SumsBelow {
    TableNumber<T> weight, solid_angle;

    /// Uninitialised: to be assigned to before it is used.
    SumsBelow() = default;

    /// \param i, j     texel with the position.
    /// \param right, up of the texel before the position, 0 to 1.
    NUSSELT_INLINE SumsBelow(const RectifiedTable<T>& table, int i, int j, const T& right,
                             const T& up) noexcept {
        using Sum = TableNumber<T>;
        const RectifiedSums* low = table.sums + table.index(i, j);
        const RectifiedSums* high = low + (table.width + 1);
        const auto mixed = [&](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
            const Sum below = static_cast<Sum>(a) + Sum(right) * static_cast<Sum>(b - a);
            const Sum above = static_cast<Sum>(c) + Sum(right) * static_cast<Sum>(d - c);
            return below + Sum(up) * (above - below);
        };
        weight = mixed(low[0].weight, low[1].weight, high[0].weight, high[1].weight);
        solid_angle = mixed(low[0].solid_angle, low[1].solid_angle, high[0].solid_angle, high[1].solid_angle);
    }
};

/// The part of a refined texel in a window: which share of it lies where.
template <class T>
class RefinedPart {
    using Refined = RefinedTexels<T>;
    static constexpr int kParts = Refined::kParts;

public:
    /// \param weight  of the parts of the texel.
    /// \param corner  of the texel, in offsets.
    /// \param x, y    begin and end of what the window has of it.
    NUSSELT_HD RefinedPart(const T* weight, const Vec2<T>& corner, const Vec2<T>& x,
                           const Vec2<T>& y) noexcept
        : weight_(weight) {
        for (int k = 0; k <= kParts; ++k) {
            const T at = static_cast<T>(k) / T(kParts);
            line_x_[k] = k == 0 ? x.x : k == kParts ? x.y : min(max(corner.x + at, x.x), x.y);
            line_y_[k] = k == 0 ? y.x : k == kParts ? y.y : min(max(corner.y + at, y.x), y.y);
        }
        for (int k = 0; k < kParts; ++k) {
            T sum = T(0);
            for (int l = 0; l < kParts; ++l) sum += height(l) * weight_[l * kParts + k];
            column_[k] = sum * (line_x_[k + 1] - line_x_[k]);
        }
    }

    /// An offset with a density in proportion to the weights.
    NUSSELT_HD Vec2<T> sample(const Vec2<T>& u) const noexcept {
        int k = 0, l = 0;
        const auto of_column = [&](int i) { return column_[i]; };
        const T x = choose(line_x_, u.x, of_column, k);
        const auto of_row = [&](int i) { return height(i) * weight_[i * kParts + k]; };
        const T y = choose(line_y_, u.y, of_row, l);
        return {x, y};
    }

    /// The density over that of a uniform point.
    NUSSELT_HD T density(const Vec2<T>& offset) const noexcept {
        T total = T(0);
        for (int k = 0; k < kParts; ++k) total += column_[k];
        const T area = (line_x_[kParts] - line_x_[0]) * (line_y_[kParts] - line_y_[0]);
        if (!(total > T(0)) || !(area > T(0))) return T(1);
        return weight_[part_at(line_y_, offset.y) * kParts + part_at(line_x_, offset.x)] * (area / total);
    }

    /// The random numbers that lead to an offset.
    NUSSELT_HD Vec2<T> invert(const Vec2<T>& offset) const noexcept {
        const int k = part_at(line_x_, offset.x);
        const auto of_column = [&](int i) { return column_[i]; };
        const auto of_row = [&](int i) { return height(i) * weight_[i * kParts + k]; };
        return {number(line_x_, offset.x, of_column), number(line_y_, offset.y, of_row)};
    }

private:
    NUSSELT_HD T height(int l) const noexcept { return line_y_[l + 1] - line_y_[l]; }
    NUSSELT_HD static int part_at(const T (&line)[kParts + 1], const T& offset) noexcept {
        int k = 0;
        for (int i = 1; i < kParts; ++i) k = offset >= line[i] ? i : k;
        // An empty part begins where the next one does, or where the window ends.
        while (k > 0 && !(line[k + 1] > line[k])) --k;
        return k;
    }
    template <class Weight>
    NUSSELT_HD static T choose(const T (&line)[kParts + 1], const T& u, const Weight& weight,
                               int& part) noexcept {
        T total = T(0);
        for (int k = 0; k < kParts; ++k) total += weight(k);
        if (!(total > T(0))) return line[0] + u * (line[kParts] - line[0]);
        T rest = u * total;
        part = -1;
        for (int k = 0; k < kParts; ++k) {
            const T here = weight(k);
            if (!(here > T(0))) continue;
            // Rounding may leave a rest after the last part.
            if (part >= 0) rest -= weight(part);
            part = k;
            if (rest < here) break;
        }
        const T share = below_one(max(rest, T(0)) / weight(part));
        return line[part] + share * (line[part + 1] - line[part]);
    }
    template <class Weight>
    NUSSELT_HD static T number(const T (&line)[kParts + 1], const T& offset, const Weight& weight) noexcept {
        const int part = part_at(line, offset);
        T total = T(0), before = T(0);
        for (int k = 0; k < kParts; ++k) {
            before += k < part ? weight(k) : T(0);
            total += weight(k);
        }
        const T size = line[part + 1] - line[part];
        const T share = size > T(0) ? below_one(max((offset - line[part]) / size, T(0))) : T(0);
        return total > T(0) ? below_one((before + share * weight(part)) / total) : T(0);
    }

    const T* weight_;
    T line_x_[kParts + 1], line_y_[kParts + 1]; ///< of its parts, within the window
    T column_[kParts];
};

} // namespace detail

/// A rectangle of a table.
template <class T>
struct TableWindow {
    const RectifiedTable<T>& table;
    TableAxis<T> across, along; ///< alpha and beta
    TexelInterval<T> columns, rows;

    /// Sums where parts of texels have their share by area in (alpha, beta), over those of the table.
    NUSSELT_HD WindowSums<T> sums() const noexcept {
        constexpr T kShare = T(1) / RectifiedTable<T>::kWhole;
        WindowSums<T> total{T(0), T(0), T(0)};
        for (int k = 0; k < 3; ++k) {
            const T share_x = kShare * across.share(columns, k);
            for (int l = 0; l < 3; ++l) {
                const T share = share_x * along.share(rows, l);
                if (!(share > T(0))) continue;
                const RectifiedSums part =
                    table.sum(columns.edge(k), columns.edge(k + 1), rows.edge(l), rows.edge(l + 1));
                total.weight += share * static_cast<T>(part.weight);
                total.square += share * static_cast<T>(part.square);
                total.solid_angle += share * static_cast<T>(part.solid_angle);
            }
        }
        return total;
    }

    /// The squared coefficient of variation of the radiance of texels, by solid angle.
    NUSSELT_HD T variation() const noexcept {
        const WindowSums<T> s = sums();
        if (!(s.weight > T(0))) return T(0);
        return max(table.mean_square * (s.square / s.weight) * (s.solid_angle / s.weight) - T(1), T(0));
    }

    /// A point with a density in proportion to the weight of its texel, uniform in (alpha, beta) within it, or within parts of
    /// refined texels. The window has to have a weight.
    NUSSELT_HD WindowPoint<T> sample(const Vec2<T>& u) const noexcept {
        constexpr T kBelowOne = 1 - std::numeric_limits<T>::epsilon() / 2;
        const auto choose = [&](const TexelInterval<T>& interval, const T& number, const auto& sum_to,
                                int& texel) {
            const T target = min(number, kBelowOne) * sum_to(interval.last);
            int low = interval.first, high = interval.last;
            while (low < high) {
                const int middle = (low + high) / 2;
                if (sum_to(middle) > target)
                    high = middle;
                else
                    low = middle + 1;
            }
            texel = low;
            const T before = low > interval.first ? sum_to(low - 1) : T(0);
            return below_one((target - before) / max(sum_to(low) - before, std::numeric_limits<T>::min()));
        };
        WindowPoint<T> point;
        Vec2<T> rest;
        rest.x = choose(
            columns, u.x, [&](int i) { return sum_to_column(i); }, point.i);
        rest.y = choose(
            rows, u.y, [&](int j) { return sum_to_row(point.i, j); }, point.j);
        const Vec2<T> x = across.part(columns, point.i);
        const Vec2<T> y = along.part(rows, point.j);
        point.offset = {x.x + rest.x * (x.y - x.x), y.x + rest.y * (y.y - y.x)};
        if (const T* const parts = parts_of(point)) point.offset = refined_part(parts, point).sample(rest);
        return point;
    }

    /// The random numbers that lead to offsets in the window.
    NUSSELT_HD Vec2<T> invert(const Vec2<T>& offset) const noexcept {
        const auto number = [](const TexelInterval<T>& interval, int texel, const T& rest,
                               const auto& sum_to) {
            const T total = sum_to(interval.last);
            const T before = texel > interval.first ? sum_to(texel - 1) : T(0);
            return total > T(0) ? below_one((before + rest * (sum_to(texel) - before)) / total) : T(0);
        };
        const auto share = [](const Vec2<T>& part, const T& position) {
            const T size = part.y - part.x;
            return size > T(0) ? below_one((position - part.x) / size) : T(0);
        };
        const WindowPoint<T> point = point_at(offset);
        Vec2<T> rest{share(across.part(columns, point.i), offset.x),
                     share(along.part(rows, point.j), offset.y)};
        if (const T* const parts = parts_of(point)) rest = refined_part(parts, point).invert(offset);
        return {number(columns, point.i, rest.x, [&](int i) { return sum_to_column(i); }),
                number(rows, point.j, rest.y, [&](int j) { return sum_to_row(point.i, j); })};
    }

    /// The texel of the window with these offsets.
    NUSSELT_HD WindowPoint<T> point_at(const Vec2<T>& offset) const noexcept {
        const auto within = [](int i, const TexelInterval<T>& interval) {
            return i < interval.first ? interval.first : i > interval.last ? interval.last : i;
        };
        return {within(across.texel_at(offset.x), columns), within(along.texel_at(offset.y), rows), offset};
    }

    /// The density of sample() per square texel.
    NUSSELT_HD T pdf(const WindowPoint<T>& point) const noexcept {
        constexpr T kShare = T(1) / RectifiedTable<T>::kWhole;
        const T weight = kShare * static_cast<T>(weight_of({{point.i, point.j}, {point.i + 1, point.j + 1}}));
        const T total = sums().weight;
        if (!(total > T(0))) return T(0);
        const T* const parts = parts_of(point);
        return weight / total * (parts != nullptr ? refined_part(parts, point).density(point.offset) : T(1));
    }

    /// The smallest rectangle of whole texels with all of the weight of those that the window meets.
    NUSSELT_HD TexelRectangle lit() const noexcept {
        TexelRectangle lit{{columns.first, rows.first}, {columns.last + 1, rows.last + 1}};
        if (weight_of(lit) == 0) return {{0, 0}, {0, 0}};
        for (int axis = 0; axis < 2; ++axis) {
            lit.begin[axis] = last_where(lit.begin[axis], lit.end[axis] - 1, [&](int i) {
                TexelRectangle left_out = lit;
                left_out.end[axis] = i;
                return weight_of(left_out) == 0;
            });
            lit.end[axis] = -last_where(-lit.end[axis], -(lit.begin[axis] + 1), [&](int i) {
                TexelRectangle left_out = lit;
                left_out.begin[axis] = -i;
                return weight_of(left_out) == 0;
            });
        }
        return lit;
    }

private:
    /// The last number up to `last` for which a condition holds that holds for the first one, and for none beyond those for
    /// which it holds. That is mostly the first one.
    template <class Condition>
    NUSSELT_HD static int last_where(int first, int last, const Condition& holds) noexcept {
        if (first < last && !holds(first + 1)) return first;
        while (first < last) {
            const int middle = last - (last - first) / 2;
            if (holds(middle))
                first = middle;
            else
                last = middle - 1;
        }
        return first;
    }
    NUSSELT_HD std::int64_t weight_of(const TexelRectangle& r) const noexcept {
        return table.sum(r.begin[0], r.end[0], r.begin[1], r.end[1]).weight;
    }

    /// The weights of the parts of a texel, null if it has none.
    NUSSELT_HD const T* parts_of(const WindowPoint<T>& point) const noexcept {
        return table.refined.count > 0
                   ? table.refined.find(static_cast<std::int32_t>(point.j * table.width + point.i))
                   : nullptr;
    }
    NUSSELT_HD detail::RefinedPart<T> refined_part(const T* parts,
                                                   const WindowPoint<T>& point) const noexcept {
        return {parts,
                {across.edge(point.i), along.edge(point.j)},
                across.part(columns, point.i),
                along.part(rows, point.j)};
    }

    /// The weight of columns from one to before another, all of them whole.
    NUSSELT_HD T strip(int first, int end) const noexcept {
        T total = T(0);
        for (int k = 0; k < 3; ++k) {
            const T share = along.share(rows, k);
            if (share > T(0))
                total += share * static_cast<T>(table.sum(first, end, rows.edge(k), rows.edge(k + 1)).weight);
        }
        return total;
    }
    /// The weight of columns up to the end of one. Grows with it, in spite of rounding.
    NUSSELT_HD T sum_to_column(int i) const noexcept {
        T total = across.share(columns, 0) * strip(columns.first, columns.first + 1);
        if (i == columns.first) return total;
        const int end = i < columns.last ? i + 1 : columns.last;
        total += strip(columns.first + 1, end);
        if (i < columns.last) return total;
        return total + across.share(columns, 2) * strip(i, i + 1);
    }
    /// The same over rows in one whole column.
    NUSSELT_HD T sum_to_row(int i, int j) const noexcept {
        const auto part = [&](int first, int end) {
            return static_cast<T>(table.sum(i, i + 1, first, end).weight);
        };
        T total = along.share(rows, 0) * part(rows.first, rows.first + 1);
        if (j == rows.first) return total;
        const int end = j < rows.last ? j + 1 : rows.last;
        total += part(rows.first + 1, end);
        if (j < rows.last) return total;
        return total + along.share(rows, 2) * part(j, j + 1);
    }
};

NUSSELT_NAMESPACE_END
