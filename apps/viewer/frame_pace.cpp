#include "frame_pace.h"

namespace nusselt::viewer {

int FramePace::reduction(bool is_moving) const {
    if (!is_moving) return 1;
    int reduction = 1;
    while (reduction < kLargestReduction && full_seconds_ > kTarget * reduction * reduction) reduction *= 2;
    return reduction;
}

void FramePace::note(int reduction, double seconds) {
    // Frames have costs beside those of pixels. Thus the estimate from a small frame is too high, and a resolution that is
    // chosen by it is never given up again after its own frame was measured.
    full_seconds_ = seconds * reduction * reduction;
}

} // namespace nusselt::viewer
