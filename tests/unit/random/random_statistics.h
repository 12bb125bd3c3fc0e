#pragma once
/// Chi-square tests for generators of random numbers.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nusselt::test {

/// Probability that a chi-square variable is at least this large (E. Wilson, M. Hilferty 1931): within 1 % for the
/// hundreds of degrees of freedom used here.
inline double chi_square_p_value(double statistic, double degrees) {
    const double variance = 2 / (9 * degrees);
    const double z = (std::cbrt(statistic / degrees) - (1 - variance)) / std::sqrt(variance);
    return std::erfc(z / std::sqrt(2.0)) / 2;
}

/// Significance level of each of `tests` independent tests for which all pass with probability 1 - 1e-3 if nothing is
/// wrong.
inline double sidak_level(int tests) { return -std::expm1(std::log1p(-1e-3) / tests); }

/// Counts the points of the unit square in each of kCells x kCells cells.
class CellCounts {
public:
    static constexpr int kCells = 16;

    /// \param u,v in [0, 1]; 1 belongs to the last cell.
    void add(double u, double v) {
        ++counts_[static_cast<std::size_t>(cell(u) * kCells + cell(v))];
        ++total_;
    }

    /// The p-value of the hypothesis that the points are uniform and their coordinates independent.
    double p_value() const {
        const double expected = static_cast<double>(total_) / static_cast<double>(counts_.size());
        double statistic = 0;
        for (const int count : counts_) statistic += (count - expected) * (count - expected) / expected;
        return chi_square_p_value(statistic, static_cast<double>(counts_.size()) - 1);
    }

private:
    static int cell(double u) { return std::min(static_cast<int>(u * kCells), kCells - 1); }

    std::vector<int> counts_ = std::vector<int>(kCells * kCells);
    int total_ = 0;
};

} // namespace nusselt::test
