#pragma once
/// Straight lines through measured points.

#include <cstddef>
#include <numeric>
#include <vector>

namespace nusselt_test {

inline double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The slope of y over x, by least squares. There must be two different x.
inline double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
    const double mean_x = mean_of(x);
    const double mean_y = mean_of(y);
    double product = 0;
    double spread = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        product += (x[i] - mean_x) * (y[i] - mean_y);
        spread += (x[i] - mean_x) * (x[i] - mean_x);
    }
    return product / spread;
}

} // namespace nusselt_test
