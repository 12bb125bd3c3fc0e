#pragma once
/// How samples choose one cell of a lattice: a column, then a cell of it, in proportion to weights.

#include <nusselt/emission/cell_lanes.h>
#include <nusselt/emission/lane_index.h>

NUSSELT_NAMESPACE_BEGIN

/// A cell of a lattice, and how likely it is.
template <class Real>
struct CellChoice {
    detail::index_t<Real> column, row;
    Real probability;
    Vec2<Real> u; ///< random numbers that are left, in [0, 1)^2

    /// Its place in arrays with a number per cell of a lattice of n columns.
    NUSSELT_HD detail::LanePlaces<Real> place(int n) const noexcept {
        return detail::places<Real>(column, row, n);
    }
};

/// Running sums of the weights of cells.
/// \tparam Real float, double, long double or a pack, with a lattice per lane.
/// \tparam n    columns and rows: 4, or 8 and 16, which add() needs for scalars. Cell (i, j) has the index j * n + i.
template <class Real, int n>
class CellSums {
    using Lanes = detail::CellLanes<Real>;
    using L = typename Lanes::Type;
    using Index = detail::index_t<Real>;
    using Scalar = scalar_t<Real>;
    static constexpr int kPoints = Lanes::kPoints;

public:
    /// Appends the next cells: all of them have to be added, in the order of their indices.
    /// \param cell   index of the first lane.
    /// \param weight not negative.
    NUSSELT_INLINE void add(int cell, const L& weight) noexcept {
        const L before = cell >= n ? Lanes::load(sum_ + kPoints * (cell - n)) : L(Scalar(0));
        Lanes::store(sum_ + kPoints * cell, before + weight);
    }

    /// Sets all cells of a column, where packs of cells of a row are not at hand.
    /// \param weight not negative.
    NUSSELT_HD void set_column(int column, const Real (&weight)[n]) noexcept {
        static_assert(kPoints == 1, "packs have one cell after the other in any case");
        Real sum = Real(0);
        for (int row = 0; row < n; ++row) {
            sum += weight[row];
            sum_[row * n + column] = sum;
        }
    }

    /// After the last cell.
    NUSSELT_HD void finish() noexcept {
        Real total = Real(0);
        for (int i = 0; i < n; ++i) {
            total += detail::load_lanes<Real>(sum_ + kPoints * ((n - 1) * n + i));
            detail::store_lanes(column_sum_ + kPoints * i, total);
        }
        total_ = select((total > Real(0)) & is_finite(total), total, Real(0));
    }

    /// From now on, these lanes have no cell to choose.
    NUSSELT_HD void clear(const mask_t<Real>& lanes) noexcept { total_ = select(lanes, Real(0), total_); }

    /// The sum of all weights; 0 if it is not finite.
    NUSSELT_HD Real total() const noexcept { return total_; }

    /// \param u in [0, 1)^2; x chooses the column. Only for lanes whose total() is positive.
    NUSSELT_HD CellChoice<Real> choose(const Vec2<Real>& u) const noexcept {
        const Real target_x = below_one(u.x) * total_;
        const Index column = first_above(target_x, [&](const Index& i) { return column_sum(i); });
        const Real target_y = below_one(u.y) * sum(column, Index(n - 1));
        const Index row = first_above(target_y, [&](const Index& j) { return sum(column, j); });
        const Step column_step = step_of_column(column);
        const Step cell_step = step_of_cell(column, row);
        return {column,
                row,
                column_step.probability() * cell_step.probability(),
                {column_step.rest(target_x), cell_step.rest(target_y)}};
    }

    /// A cell by its place.
    NUSSELT_HD CellChoice<Real> cell(const Index& column, const Index& row) const noexcept {
        return {column,
                row,
                step_of_column(column).probability() * step_of_cell(column, row).probability(),
                {Real(0), Real(0)}};
    }
    /// The weight of a cell, up to rounding.
    NUSSELT_HD Real weight(const Index& column, const Index& row) const noexcept {
        const Step step = step_of_cell(column, row);
        return step.after - step.before;
    }

    /// The cell at a point of the lattice.
    /// \param at in [0, 1)^2.
    NUSSELT_HD CellChoice<Real> at(const Vec2<Real>& at) const noexcept {
        return cell(detail::index_below<Real>(at.x * Real(n), n),
                    detail::index_below<Real>(at.y * Real(n), n));
    }

    /// What choose() undoes.
    /// \param u in the cell.
    NUSSELT_HD Vec2<Real> unite(const Index& column, const Index& row, const Vec2<Real>& u) const noexcept {
        return {step_of_column(column).united(u.x), step_of_cell(column, row).united(u.y)};
    }

private:
    /// One step of running sums.
    struct Step {
        Real before, after, total;

        NUSSELT_HD Real probability() const noexcept {
            return select(total > Real(0), (after - before) / total, Real(0));
        }
        NUSSELT_HD Real rest(const Real& target) const noexcept {
            return below_one((target - before) /
                             max(after - before, Real(std::numeric_limits<Scalar>::min())));
        }
        NUSSELT_HD Real united(const Real& u) const noexcept {
            return select(total > Real(0), below_one((before + u * (after - before)) / total), Real(0));
        }
    };

    NUSSELT_INLINE Real column_sum(const Index& column) const noexcept {
        return detail::places<Real>(column, Index(0), 0).load_own(column_sum_);
    }
    NUSSELT_INLINE Real sum(const Index& column, const Index& row) const noexcept {
        return detail::places<Real>(column, row, n).load_own(sum_);
    }
    /// f(i - 1), or 0 for the first one.
    template <class Function>
    NUSSELT_INLINE static Real before(const Index& i, const Function& f) noexcept {
        const auto has = i > Index(0);
        const Real value = f(detail::select_index<Real>(has, i - Index(1), Index(0)));
        return select(has, value, Real(0));
    }
    NUSSELT_INLINE Step step_of_column(const Index& column) const noexcept {
        return {before(column, [&](const Index& i) { return column_sum(i); }), column_sum(column), total_};
    }
    NUSSELT_INLINE Step step_of_cell(const Index& column, const Index& row) const noexcept {
        return {before(row, [&](const Index& j) { return sum(column, j); }), sum(column, row),
                sum(column, Index(n - 1))};
    }

    /// The first of n running sums above a target that is below the last one.
    template <class SumAt>
    NUSSELT_INLINE static Index first_above(const Real& target, const SumAt& sum_at) noexcept {
        Index found = Index(0);
        if constexpr (kPoints == 1) {
            // Comparisons that do not wait for each other: all, or a quarter of the sums at a time.
            constexpr int kParts = n == 8 ? 8 : 4;
            for (int step = n / kParts; step > 0; step /= kParts) {
                int passed = 0;
                for (int k = 1; k < kParts; ++k) passed += sum_at(found + k * step - 1) <= target ? 1 : 0;
                found += passed * step;
            }
        } else {
            for (int step = n / 2; step > 0; step /= 2) {
                const Index next = found + Index(step);
                found = detail::select_index<Real>(sum_at(next - Index(1)) <= target, next, found);
            }
        }
        return found;
    }

    alignas(Real) Scalar sum_[n * n * kPoints];    ///< of weights of a column, up to each row
    alignas(Real) Scalar column_sum_[n * kPoints]; ///< of columns
    Real total_;
};

NUSSELT_NAMESPACE_END
