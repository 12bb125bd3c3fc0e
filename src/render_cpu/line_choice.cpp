#include "render_cpu/line_choice.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render_cpu {

namespace {

// Calibrated with `nusselt bench line-efficiency`: tracing takes time in proportion to the blocks, whatever the number of
// lines; points in place of the lines take time in proportion to their number.
constexpr double kBlocksPerLine = 2.5;
constexpr double kPointsExponent = 1.4;

/// Of a pixel and light: what stratified samples are made for.
constexpr int kMostPoints = 1 << 22;

} // namespace

int most_occluders_for_lines(int lines) {
    return static_cast<int>(std::lround(kBlocksPerLine * lines));
}

int points_in_place_of_lines(int lines, int camera_rays) {
    const int most = std::clamp(kMostPoints / camera_rays, 1, kMaxSamples);
    return static_cast<int>(std::min<double>(std::round(std::pow(lines, kPointsExponent)), most));
}

} // namespace nusselt::render_cpu
