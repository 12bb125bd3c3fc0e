#include "render_cpu/line_choice.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render_cpu {

int most_occluders_for_lines(int lines) {
    // Fewer lines take as long as a pack of them, but are noisier.
    constexpr int kFewestLines = 16;
    if (lines < kFewestLines) return -1;
    return static_cast<int>(std::lround(40 * std::pow(lines / 16.0, 1.5)));
}

int points_in_place_of_lines(int lines) {
    // Squares have the best strata.
    const double side = std::min(std::round(std::pow(lines, 0.7)), std::sqrt(kMaxSamples));
    return static_cast<int>(side * side);
}

} // namespace nusselt::render_cpu
