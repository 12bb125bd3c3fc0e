#include "render/choices/line_choice.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render {

namespace {

// Measured by `nusselt-lab bench line-efficiency`, not derived (docs/performance.md, entry 37): the more lines there are, the
// fewer blocks concern each pack, since neighbours share one.
constexpr double kBlocksPerSquaredLine = 24.0 / (16 * 16);
constexpr double kPointsExponent = 1.4;

/// With AVX-512, fewer lines take as long as this many. All instruction sets use the same number, so that their images
/// use points in the same places.
constexpr int kFewestLines = 16;

/// The number of points per pixel and light for which stratified samples are designed.
constexpr int kMostPoints = 1 << 22;

} // namespace

int most_occluders_for_lines(int lines) {
    if (lines < kFewestLines) return -1;
    const double blocks = kBlocksPerSquaredLine * lines * lines;
    return static_cast<int>(std::lround(blocks));
}

int points_in_place_of_lines(int lines, int camera_rays) {
    const int most = std::clamp(kMostPoints / camera_rays, 1, render::kMaxSamples);
    // Powers of two, whose permutations take half the time of others.
    const long exponent = std::lround(kPointsExponent * std::log2(lines));
    return 1 << std::min(exponent, std::lround(std::floor(std::log2(most))));
}

} // namespace nusselt::render
