#pragma once
/// Independent means of an estimator over randomised nets.

#include <cstdint>
#include <random>
#include <vector>

#include <nusselt/random/sobol.h>
#include <nusselt/random/unit_interval.h>

#include "hypothesis.h"

namespace nusselt_test {

inline constexpr int kReplicates = 17;
inline constexpr std::uint32_t kPoints = 256;

/// \param estimate computes a value from a function that returns random points. The points of all calls form a net.
template <class Estimate>
std::vector<double> means_of(const Estimate& estimate) {
    std::mt19937 engine(7);
    std::vector<double> means;
    for (int r = 0; r < kReplicates; ++r) {
        double sum = 0;
        std::uint32_t seeds[8];
        for (std::uint32_t& seed : seeds) seed = static_cast<std::uint32_t>(engine());
        for (std::uint32_t i = 0; i < kPoints; ++i) {
            const nusselt::UInt2 bits = nusselt::sobol(i);
            const std::uint32_t* seed = seeds;
            sum += estimate([&] {
                const double x = nusselt::to_unit<double>(nusselt::owen_scramble(bits.x, *seed++));
                return nusselt::Vec2<double>{
                    x, nusselt::to_unit<double>(nusselt::owen_scramble(bits.y, *seed++))};
            });
        }
        means.push_back(sum / kPoints);
    }
    return means;
}

} // namespace nusselt_test
