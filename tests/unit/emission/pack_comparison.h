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
    /// Rounding may lead to another texel, whose density differs, or decide next to black parts, where densities are steep.
    /// \param least how many lanes there have to be more of
    /// \param one_in so many lanes, fewer than one may differ
    void expect_agreement(int least, int one_in) const {
        EXPECT_GT(count_, least);
        EXPECT_LT(different_, count_ / one_in) << "of " << count_;
    }

private:
    static constexpr T kTolerance = 4096 * std::numeric_limits<T>::epsilon();
    int count_ = 0;
    int different_ = 0;
};

} // namespace nusselt_test
