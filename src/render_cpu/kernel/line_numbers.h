#pragma once
/// Random numbers of lines, ordered so that neighbouring lines share a pack.

#include "render_cpu/kernel/lanes.h"
#include "visibility/line_traversal.h"

#include <cstdint>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Random numbers of the lines that are traced at once. Packs of neighbouring lines share fewer occluders with other
/// packs, so the total number of cuts grows more slowly than the number of packs.
class LineNumbers {
public:
    static constexpr std::uint32_t kMost = kLanes * kLargestLinePackCount;

    /// \param count  at most kMost
    /// \param random function that maps the number of the first line of a pack to the random numbers of the pack
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
    /// Uses as many strata as there are numbers. This sorts stratified numbers completely and all others almost.
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

    // The lanes after the last number also hold random numbers.
    alignas(64) float x_[kMost];
    alignas(64) float y_[kMost];
};

} // namespace kernel
NUSSELT_NAMESPACE_END
