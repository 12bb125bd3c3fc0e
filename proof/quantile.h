#pragma once
/// Quantiles of measurements.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nusselt::proof {

/// The value below which the given share of the values lies: the nearest one. \param values not empty.
inline double quantile(std::vector<double> values, double share) {
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

inline double half_interquartile_range(const std::vector<double>& values) {
    return (quantile(values, 0.75) - quantile(values, 0.25)) / 2;
}

/// The same of ascending values, rounded towards the first one; 0 if there are none.
inline double quantile_of_sorted(const std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

} // namespace nusselt::proof
