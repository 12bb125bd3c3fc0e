#pragma once
/// How tests compare the lanes of packs with scalars.

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace nusselt_test {

/// Counts lanes that differ from scalars by more than rounding.
template <class T>
class Comparison {
public:
    void add(T scalar, T lane) {
        ++count_;
        const T largest = std::max({std::fabs(scalar), std::fabs(lane), T(1e-6)});
        if (!(std::fabs(scalar - lane) <= kTolerance * largest)) ++different_;
    }
    /// Rounding may lead to another texel, whose density differs.
    void expect_agreement() const {
        EXPECT_GT(count_, 3000);
        EXPECT_LT(different_, count_ / 500) << "of " << count_;
    }

private:
    static constexpr T kTolerance = 4096 * std::numeric_limits<T>::epsilon();
    int count_ = 0;
    int different_ = 0;
};

} // namespace nusselt_test
