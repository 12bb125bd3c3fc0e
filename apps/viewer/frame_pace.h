#pragma once
/// The resolution of frames while something moves.

#include <limits>

namespace nusselt::viewer {

/// Chooses the resolution by the time that frames took before.
class FramePace {
public:
    /// What a frame may take while something moves [s].
    static constexpr double kTarget = 0.1;
    static constexpr int kLargestReduction = 8;

    /// \returns the side of the squares of pixels that share a pixel of the next frame, a power of two: 1 at rest
    int reduction(bool is_moving) const;

    /// \param seconds that a frame of this reduction took
    void note(int reduction, double seconds);

private:
    double full_seconds_ = std::numeric_limits<double>::infinity(); ///< estimate for a frame of all pixels
};

} // namespace nusselt::viewer
