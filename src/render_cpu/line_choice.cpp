#include "render_cpu/line_choice.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render_cpu {

int most_occluders_for_lines(int lines) {
    // Cornell boxes and Sponza have up to 256 blocks in a pyramid, and 3 to 11 us for 16 lines; the bathroom mostly has more
    // than 2048, and 130 us. Points in place of 16 lines take 4 to 8 us.
    return static_cast<int>(std::lround(2 * std::pow(lines, 1.5)));
}

int points_in_place_of_lines(int lines) {
    const double points = std::round(std::pow(lines, 1.4));
    return static_cast<int>(std::min<double>(points, kMaxSamples));
}

} // namespace nusselt::render_cpu
