#include "fit/void_and_cluster.h"

#include <nusselt/random/blue_noise.h>
#include <nusselt/random/pcg.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nusselt::fit {

namespace {

/// The share of pixels in the first pattern. Ulichney advises against more than half.
constexpr int kPixelsPerPoint = 10;
/// The energy of a point in its pixel. A sum over 2^20 pixels fits.
constexpr double kEnergyUnit = 0x1p40;

/// A set of pixels of the square, and how crowded each pixel is.
class Pattern {
public:
    Pattern(int side, double sigma) : side_(static_cast<std::size_t>(side)) {
        const auto squared_distance = [side](int i) {
            const double distance = std::min(i, side - i);
            return distance * distance;
        };
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                gaussian_.push_back(
                    std::llround(kEnergyUnit * std::exp(-(squared_distance(x) + squared_distance(y)) /
                                                        (2 * sigma * sigma))));
        has_point_.resize(gaussian_.size());
        energies_.resize(gaussian_.size());
    }

    std::size_t size() const { return has_point_.size(); }
    bool has_point(std::size_t pixel) const { return has_point_[pixel]; }

    void insert(std::size_t pixel) {
        has_point_[pixel] = true;
        add_energy(pixel, 1);
    }
    void remove(std::size_t pixel) {
        has_point_[pixel] = false;
        add_energy(pixel, -1);
    }

    /// The most crowded pixel with a point; there must be one.
    std::size_t tightest_cluster() const {
        return extreme(true, [](std::int64_t a, std::int64_t b) { return a > b; });
    }
    /// The least crowded pixel without a point; there must be one.
    std::size_t largest_void() const {
        return extreme(false, [](std::int64_t a, std::int64_t b) { return a < b; });
    }

private:
    void add_energy(std::size_t pixel, std::int64_t sign) {
        const std::size_t column = pixel % side_, row = pixel / side_;
        for (std::size_t y = 0; y < side_; ++y) {
            const std::int64_t* gaussian = &gaussian_[(y + side_ - row) % side_ * side_];
            std::int64_t* energies = &energies_[y * side_];
            for (std::size_t x = 0; x < column; ++x) energies[x] += sign * gaussian[x + side_ - column];
            for (std::size_t x = column; x < side_; ++x) energies[x] += sign * gaussian[x - column];
        }
    }

    template <class Before>
    std::size_t extreme(bool with_point, Before before) const {
        std::size_t best = size();
        for (std::size_t i = 0; i < size(); ++i)
            if (has_point_[i] == with_point && (best == size() || before(energies_[i], energies_[best])))
                best = i;
        return best;
    }

    std::size_t side_;
    std::vector<std::int64_t> gaussian_; ///< around pixel 0
    std::vector<std::int64_t> energies_;
    std::vector<bool> has_point_;
};

/// Random pixels, moved from the tightest cluster to the largest void until that changes nothing.
Pattern make_prototype(int side, double sigma, std::uint64_t seed) {
    Pattern pattern(side, sigma);
    Pcg32 random(seed);
    for (std::size_t missing = std::max<std::size_t>(1, pattern.size() / kPixelsPerPoint); missing > 0;) {
        const auto pixel = static_cast<std::size_t>((std::uint64_t{random()} * pattern.size()) >> 32);
        if (pattern.has_point(pixel)) continue;
        pattern.insert(pixel);
        --missing;
    }
    for (;;) {
        const std::size_t cluster = pattern.tightest_cluster();
        pattern.remove(cluster);
        const std::size_t empty = pattern.largest_void();
        pattern.insert(empty);
        if (empty == cluster) return pattern;
    }
}

} // namespace

std::vector<std::uint16_t> void_and_cluster(int side, double sigma, std::uint64_t seed) {
    Pattern pattern = make_prototype(side, sigma, seed);
    std::vector<std::uint16_t> ranks(pattern.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < pattern.size(); ++i) count += pattern.has_point(i) ? 1 : 0;

    Pattern shrinking = pattern;
    for (std::size_t rank = count; rank-- > 0;) {
        const std::size_t cluster = shrinking.tightest_cluster();
        shrinking.remove(cluster);
        ranks[cluster] = static_cast<std::uint16_t>(rank);
    }
    // Beyond half, Ulichney fills the tightest cluster of pixels without a point. That is the largest void: the energies of
    // both kinds of pixels sum up to the same number everywhere.
    for (std::size_t rank = count; rank < pattern.size(); ++rank) {
        const std::size_t empty = pattern.largest_void();
        pattern.insert(empty);
        ranks[empty] = static_cast<std::uint16_t>(rank);
    }
    return ranks;
}

std::string make_blue_noise(double sigma, std::uint64_t seed) {
    std::string bytes(BlueNoiseView::kBytes, '\0');
    tbb::parallel_for(std::uint32_t{0}, BlueNoiseView::kChannels, [&](std::uint32_t channel) {
        const auto ranks = void_and_cluster(static_cast<int>(BlueNoiseView::kSide), sigma,
                                            seed * BlueNoiseView::kChannels + channel);
        std::size_t at = bytes.size() / BlueNoiseView::kChannels * channel;
        for (const std::uint16_t rank : ranks) {
            bytes[at++] = static_cast<char>(rank & 0xff);
            bytes[at++] = static_cast<char>(rank >> 8);
        }
    });
    return bytes;
}

} // namespace nusselt::fit
