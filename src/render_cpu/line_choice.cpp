#include "render_cpu/line_choice.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render_cpu {

int most_occluders_for_lines(int lines) { return static_cast<int>(std::lround(8 * std::sqrt(lines))); }

int points_in_place_of_lines(int lines) {
    const double points = std::round(std::pow(lines, 1.4));
    return static_cast<int>(std::min<double>(points, kMaxSamples));
}

} // namespace nusselt::render_cpu
