#pragma once
/// Permutations that are functions of a hash, and multi-jittered points.
///
/// K. Chiu, P. Shirley, C. Wang 1994, Multi-Jittered Sampling, Graphics Gems IV: n points have n strata in x, n in y and
/// a grid of cells with one point each. As A. Kensler 2013, Correlated Multi-Jittered Sampling, Pixar 13-01, advises,
/// all columns share a permutation, and so do all rows: that keeps points apart.

#include <cstdint>

#include <nusselt/core/vec.h>
#include <nusselt/random/unit_interval.h>

NUSSELT_NAMESPACE_BEGIN

/// A family of permutations of [0, n).
class Permutation {
public:
    /// \param n at least 1.
    NUSSELT_HD explicit constexpr Permutation(std::uint32_t n) noexcept : n_(n) {
        while (bits_ < 32 && ((n - 1) >> bits_) != 0) ++bits_;
        mask_ = 0xffffffffu >> (32 - bits_);
    }

    /// \param index below n.
    /// \param key   chooses the permutation; random in all bits.
    NUSSELT_HD constexpr std::uint32_t operator()(std::uint32_t index, std::uint32_t key) const noexcept {
        do index = in_power_of_two(index, key);
        while (index >= n_);
        return index;
    }

    /// Takes an index and a key per lane.
    template <int N>
    NUSSELT_HD constexpr void lanes(std::uint32_t (&index)[N], const std::uint32_t (&key)[N]) const noexcept {
        for (int i = 0; i < N; ++i) index[i] = in_power_of_two(index[i], key[i]);
        for (;;) {
            std::uint32_t beyond = 0;
            for (int i = 0; i < N; ++i) beyond |= index[i] >= n_ ? 1u : 0u;
            if (beyond == 0) return;
            for (int i = 0; i < N; ++i) {
                const std::uint32_t next = in_power_of_two(index[i], key[i]);
                index[i] = index[i] >= n_ ? next : index[i];
            }
        }
    }

private:
    /// Each step is a bijection of the numbers up to the mask: who follows the cycle of an index below n comes back to
    /// one.
    NUSSELT_HD constexpr std::uint32_t in_power_of_two(std::uint32_t index,
                                                       std::uint32_t key) const noexcept {
        // Ten rounds: with fewer, pairs of indices prefer some pairs of images.
        for (int round = 0; round < 10; ++round) {
            // High bits of products are the better ones.
            key = (key ^ (key >> 15)) * 0x9e3779b1u;
            index = ((index ^ (key >> 8)) * ((key >> 16) | 1u)) & mask_;
            index ^= index >> ((bits_ + 1) / 2);
            index = ((index >> 1) | (index << (bits_ - 1))) & mask_;
        }
        return index;
    }

    std::uint32_t n_;
    std::uint32_t bits_ = 1; ///< of n - 1
    std::uint32_t mask_ = 0; ///< that many ones
};

/// The grid of multi-jittered points.
struct StratumGrid {
    std::uint32_t columns, rows; ///< columns * rows is the number of points

    /// The grid is as close to a square as the divisors of n allow. It costs up to sqrt(n) divisions, few for numbers
    /// with divisors close to sqrt(n).
    /// \param n at least 1.
    NUSSELT_HD explicit constexpr StratumGrid(std::uint32_t n) noexcept : columns(0), rows(0) {
        for (std::uint32_t bit = 1u << 15; bit > 0; bit /= 2)
            if ((columns + bit) * (columns + bit) <= n) columns += bit;
        while (n % columns != 0) --columns;
        rows = n / columns;
    }

    /// Exact for numbers of points up to 2^24. As floats, since there are no divisions of integers in SIMD: beyond 2^22
    /// the quotient may round up to the next column.
    NUSSELT_HD constexpr std::uint32_t column_of(std::uint32_t cell) const noexcept {
        const float cells = static_cast<float>(static_cast<std::int32_t>(cell)) + 0.5f;
        const auto column = static_cast<std::uint32_t>(
            static_cast<std::int32_t>(cells / static_cast<float>(static_cast<std::int32_t>(rows))));
        return column - (column * rows > cell ? 1u : 0u);
    }
};

/// The permutations of a set of multi-jittered points; random in all bits.
struct MultiJitterKeys {
    std::uint32_t order, in_columns, in_rows;
};

namespace detail {

/// Permutes the points of each column among its strata of x, and those of each row among its strata of y.
class MultiJitter {
public:
    NUSSELT_HD explicit constexpr MultiJitter(std::uint32_t n) noexcept
        : n_(n), grid_(n), order_(n), in_columns_(grid_.rows), in_rows_(grid_.columns) {}

    template <class Scalar>
    NUSSELT_HD constexpr Vec2<Scalar> point(std::uint32_t sample, const MultiJitterKeys& keys,
                                            Scalar jitter_x, Scalar jitter_y) const noexcept {
        const std::uint32_t cell = order_(sample, keys.order);
        const std::uint32_t column = grid_.column_of(cell);
        const std::uint32_t row = cell - column * grid_.rows;
        return {uniform_jittered(jitter_x, column * grid_.rows + in_columns_(row, keys.in_columns), n_),
                uniform_jittered(jitter_y, row * grid_.columns + in_rows_(column, keys.in_rows), n_)};
    }

    /// \param u_x, u_y random numbers, which become the points.
    template <class Scalar, int N>
    NUSSELT_HD constexpr void points(const std::uint32_t (&sample)[N], const std::uint32_t (&key_order)[N],
                                     const std::uint32_t (&key_in_columns)[N],
                                     const std::uint32_t (&key_in_rows)[N], Scalar (&u_x)[N],
                                     Scalar (&u_y)[N]) const noexcept {
        std::uint32_t cell[N] = {}, column[N] = {}, row[N] = {}, x[N] = {}, y[N] = {};
        for (int i = 0; i < N; ++i) cell[i] = sample[i];
        order_.lanes(cell, key_order);
        for (int i = 0; i < N; ++i) y[i] = column[i] = grid_.column_of(cell[i]);
        for (int i = 0; i < N; ++i) x[i] = row[i] = cell[i] - column[i] * grid_.rows;
        in_columns_.lanes(x, key_in_columns);
        in_rows_.lanes(y, key_in_rows);
        for (int i = 0; i < N; ++i) u_x[i] = uniform_jittered(u_x[i], column[i] * grid_.rows + x[i], n_);
        for (int i = 0; i < N; ++i) u_y[i] = uniform_jittered(u_y[i], row[i] * grid_.columns + y[i], n_);
    }

private:
    std::uint32_t n_;
    StratumGrid grid_;
    Permutation order_, in_columns_, in_rows_;
};

} // namespace detail

/// Point number sample of n: points with the same keys have one each in n strata of x, n of y, and in the cells of
/// StratumGrid(n).
/// \param sample   below n.
/// \param n        1 to 2^22.
/// \param jitter_x, jitter_y in [0, 1), independent of each other and of those of other points.
template <class Scalar>
NUSSELT_HD constexpr Vec2<Scalar> multi_jittered(std::uint32_t sample, std::uint32_t n,
                                                 const MultiJitterKeys& keys, Scalar jitter_x,
                                                 Scalar jitter_y) noexcept {
    return detail::MultiJitter(n).point(sample, keys, jitter_x, jitter_y);
}

NUSSELT_NAMESPACE_END
