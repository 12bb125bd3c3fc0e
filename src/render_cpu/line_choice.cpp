#include "render_cpu/line_choice.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render_cpu {

int most_occluders_for_lines(int lines) {
    // Fewer lines take as long as a whole pack of them.
    constexpr int kFewestLines = 8;
    if (lines < kFewestLines) return -1;
    return static_cast<int>(std::lround(2.5 * lines));
}

int points_in_place_of_lines(int lines) {
    const double points = std::round(std::pow(lines, 1.4));
    return static_cast<int>(std::min<double>(points, kMaxSamples));
}

} // namespace nusselt::render_cpu
