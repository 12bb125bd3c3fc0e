#include "render_cpu/line_choice.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render_cpu {

namespace {

// Calibrated with `nusselt bench line-efficiency`. The time for lines grows with the number of blocks that each pack of
// them is cut with, that for points in their place with the number of points.
constexpr double kBlocksPerSquaredLine = 24.0 / (16 * 16);
constexpr double kPointsExponent = 1.4;

/// Fewer lines take as long as a whole pack of them.
constexpr int kFewestLines = 16;

/// Of a pixel and light: what stratified samples are made for.
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

} // namespace nusselt::render_cpu
