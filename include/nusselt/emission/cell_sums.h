#pragma once
/// How samples choose one cell of a lattice: a column, then a cell of it, in proportion to weights.

#include <nusselt/core/vec.h>
#include <nusselt/emission/cell_lanes.h>

NUSSELT_NAMESPACE_BEGIN

/// A cell of a lattice, and how likely it is.
template <class T>
struct CellChoice {
    int column, row;
    T probability;
    Vec2<T> u; ///< random numbers that are left, in [0, 1)^2

    /// In a lattice of n columns.
    NUSSELT_HD int index(int n) const noexcept { return row * n + column; }
};

/// Running sums of the weights of cells.
/// \tparam T float, double or long double.
/// \tparam n columns and rows: 4, or 8 and 16, which add() needs. Cell (i, j) has the index j * n + i.
template <class T, int n>
class CellSums {
    using Lanes = detail::CellLanes<T>;
    using L = typename Lanes::Type;

public:
    /// Appends the next cells: all of them have to be added, in the order of their indices.
    /// \param cell   index of the first lane.
    /// \param weight not negative.
    NUSSELT_INLINE void add(int cell, const L& weight) noexcept {
        const L before = cell >= n ? Lanes::load(sum_ + cell - n) : L(T(0));
        Lanes::store(sum_ + cell, before + weight);
    }

    /// Sets all cells of a column, where packs of cells of a row are not at hand.
    /// \param weight not negative.
    NUSSELT_HD void set_column(int column, const T (&weight)[n]) noexcept {
        T sum = T(0);
        for (int row = 0; row < n; ++row) {
            sum += weight[row];
            sum_[row * n + column] = sum;
        }
    }

    /// After the last cell.
    NUSSELT_HD void finish() noexcept {
        T total = T(0);
        for (int i = 0; i < n; ++i) {
            total += sum_[(n - 1) * n + i];
            column_sum_[i] = total;
        }
        total_ = total > T(0) && is_finite(total) ? total : T(0);
    }

    /// From now on, there is no cell to choose.
    NUSSELT_HD void clear() noexcept { total_ = T(0); }

    /// The sum of all weights; 0 if it is not finite.
    NUSSELT_HD T total() const noexcept { return total_; }

    /// \param u in [0, 1)^2; x chooses the column. Only if total() is positive.
    NUSSELT_HD CellChoice<T> choose(const Vec2<T>& u) const noexcept {
        const T target_x = below_one(u.x) * total_;
        const int column = first_above(column_sum_, 1, target_x);
        const T target_y = below_one(u.y) * sum_[(n - 1) * n + column];
        const int row = first_above(sum_ + column, n, target_y);
        CellChoice<T> choice = cell(column, row);
        choice.u = {column_step(column).rest(target_x), cell_step(column, row).rest(target_y)};
        return choice;
    }

    /// A cell by its place.
    NUSSELT_HD CellChoice<T> cell(int column, int row) const noexcept {
        return {column,
                row,
                column_step(column).probability() * cell_step(column, row).probability(),
                {T(0), T(0)}};
    }
    /// The weight of a cell, up to rounding.
    NUSSELT_HD T weight(int column, int row) const noexcept {
        const Step step = cell_step(column, row);
        return step.after - step.before;
    }

    /// The cell at a point of the lattice.
    /// \param at in [0, 1)^2.
    NUSSELT_HD CellChoice<T> at(const Vec2<T>& at) const noexcept {
        const auto index = [](const T& x) {
            const int i = static_cast<int>(x * T(n));
            return i < 0 ? 0 : i < n ? i : n - 1;
        };
        return cell(index(at.x), index(at.y));
    }

    /// What choose() undoes.
    /// \param u in the cell.
    NUSSELT_HD Vec2<T> unite(int column, int row, const Vec2<T>& u) const noexcept {
        return {column_step(column).united(u.x), cell_step(column, row).united(u.y)};
    }

private:
    /// One step of running sums.
    struct Step {
        T before, after, total;

        NUSSELT_HD T probability() const noexcept { return total > T(0) ? (after - before) / total : T(0); }
        NUSSELT_HD T rest(const T& target) const noexcept {
            return below_one((target - before) / max(after - before, std::numeric_limits<T>::min()));
        }
        NUSSELT_HD T united(const T& u) const noexcept {
            return total > T(0) ? below_one((before + u * (after - before)) / total) : T(0);
        }
    };

    NUSSELT_HD Step column_step(int column) const noexcept {
        return {column > 0 ? column_sum_[column - 1] : T(0), column_sum_[column], total_};
    }
    NUSSELT_HD Step cell_step(int column, int row) const noexcept {
        return {row > 0 ? sum_[(row - 1) * n + column] : T(0), sum_[row * n + column],
                sum_[(n - 1) * n + column]};
    }

    /// The first of n running sums above a target that is below the last one.
    NUSSELT_HD static int first_above(const T* sums, int stride, const T& target) noexcept {
        int found = 0;
        for (int step = n / 2; step > 0; step /= 2)
            found += sums[(found + step - 1) * stride] <= target ? step : 0;
        return found;
    }

    T sum_[n * n];    ///< of weights of a column, up to each row
    T column_sum_[n]; ///< of columns
    T total_;
};

NUSSELT_NAMESPACE_END
