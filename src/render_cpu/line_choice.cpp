#include "render_cpu/line_choice.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render_cpu {

namespace {

// Calibrated with `nusselt bench line-efficiency`: the time for lines grows with the number of blocks, that for points in
// their place with the number of points.
constexpr double kBlocksPerLine = 0.625; ///< over the square root of the number of lines
constexpr double kPointsExponent = 1.4;

/// Fewer lines take as long as a whole pack of them.
constexpr int kFewestLines = 16;

/// Of a pixel and light: what stratified samples are made for.
constexpr int kMostPoints = 1 << 22;

} // namespace

int most_occluders_for_lines(int lines) {
    if (lines < kFewestLines) return -1;
    return static_cast<int>(std::lround(kBlocksPerLine * std::pow(lines, 1.5)));
}

int points_in_place_of_lines(int lines, int camera_rays) {
    const int most = std::clamp(kMostPoints / camera_rays, 1, kMaxSamples);
    // Squares have the best strata.
    const double side =
        std::min(std::round(std::pow(lines, kPointsExponent / 2)), std::floor(std::sqrt(most)));
    return static_cast<int>(side * side);
}

} // namespace nusselt::render_cpu
