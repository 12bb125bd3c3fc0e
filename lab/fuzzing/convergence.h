#pragma once
/// Measures the order of convergence of the iterations: Peters 2021 (polygonal lights), Sec. 3.5, and Peters 2021
/// (linear lights), Sec. 3.3.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nusselt::lab {

/// Largest number of steps to measure.
inline constexpr int kConvergenceSteps = 4;

/// Backward errors of one light and random number after 0, 1, ... steps.
using ErrorSequence = std::array<long double, kConvergenceSteps + 1>;

/// The effect of one more step on the error.
struct ConvergenceRow {
    int steps = 0;           ///< number of steps
    double median_error = 0; ///< median of the errors after these steps
    /// Median of log(e_k) / log(e_{k-1}): the factor by which the number of correct digits grows. While errors are
    /// large, the constant factor of the convergence distorts it.
    double digit_factor = 0;
    std::size_t digit_cases = 0; ///< number of conclusive cases; if it is 0, the factor is meaningless
    /// Median of log(e_k / e_{k-1}) / log(e_{k-1} / e_{k-2}): the order, from which the constant factor cancels.
    double order = 0;
    std::size_t order_cases = 0;
};

/// Returns a row for each number of steps. Only errors well above rounding and below 0.1 determine the order.
std::vector<ConvergenceRow> convergence_of(const std::vector<ErrorSequence>& errors);

/// Errors of random lines whose projected solid angle per radius, times the distance, is at least 1e-2.
std::vector<ErrorSequence> line_errors(int count, std::uint64_t seed);

/// Errors of random sectors of at least 1e-2 sr.
std::vector<ErrorSequence> sector_errors(int count, std::uint64_t seed);

} // namespace nusselt::lab
