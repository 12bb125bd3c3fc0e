#pragma once
/// Random numbers of lines in an order that makes neighbours share a pack.

#include "render_cpu/kernel/lanes.h"
#include "visibility/line_traversal.h"

#include <cstdint>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Numbers of the lines that are traced at once. The packs of lines next to each other have fewer occluders in common
/// with other packs: what each of them is cut with grows more slowly than their number.
class LineNumbers {
public:
    static constexpr std::uint32_t kMost = kLanes * kLargestLinePackCount;

    /// \param count  at most kMost
    /// \param random function that gets the number of the first line of a pack
    template <class Random>
    LineNumbers(std::uint32_t count, const Random& random) noexcept {
        for (std::uint32_t k = 0; k < count; k += kLanes) {
            const Vec2<Real> u = random(k);
            u.x.store(x_ + k);
            u.y.store(y_ + k);
        }
        if (count > kLanes) sort_into_strata(count);
    }

    Vec2<Real> pack(std::uint32_t first) const noexcept {
        return {Real::load(x_ + first), Real::load(y_ + first)};
    }

private:
    /// As many strata as numbers: stratified ones are sorted, all others nearly.
    void sort_into_strata(std::uint32_t count) noexcept {
        const float strata = static_cast<float>(static_cast<std::int32_t>(count));
        const auto stratum = [&](float u) {
            const std::int32_t s = static_cast<std::int32_t>(u * strata);
            return static_cast<std::uint32_t>(s) < count ? static_cast<std::uint32_t>(s) : count - 1;
        };
        float x[kMost], y[kMost];
        std::uint8_t next[kMost + 1] = {};
        static_assert(kMost <= 255);
        for (std::uint32_t k = 0; k < count; ++k) {
            x[k] = x_[k];
            y[k] = y_[k];
            ++next[stratum(x[k]) + 1];
        }
        for (std::uint32_t s = 1; s < count; ++s) next[s] = static_cast<std::uint8_t>(next[s] + next[s - 1]);
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint8_t place = next[stratum(x[k])]++;
            x_[place] = x[k];
            y_[place] = y[k];
        }
    }

    // What is beyond the last number is a random one too.
    alignas(64) float x_[kMost];
    alignas(64) float y_[kMost];
};

} // namespace kernel
NUSSELT_NAMESPACE_END
