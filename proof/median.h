#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nusselt::proof {

/// \param values at least one value; for an even number, the median is the larger of the two in the middle
template <class Real>
Real median(std::vector<Real> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace nusselt::proof
