#ifndef NUSSELT_INTERFACE_DISPLAY_H
#define NUSSELT_INTERFACE_DISPLAY_H
/// The inputs of shaders/passes/display.comp, for C++ and GLSL alike.

#ifdef __cplusplus
#include <cstdint>

namespace nusselt::interface {

using uint = std::uint32_t;
#endif

const uint kDisplayGroupSide = 8u; ///< pixels of a work group, in either direction

// As render_vulkan::ToneCurve.
const uint kToneCurveNone = 0u;
const uint kToneCurveReinhard = 1u;
const uint kToneCurveFilmic = 2u;

/// How sums over frames become means. Scales are 0 without a frame.
struct ShownSums {
    float scale;
    float scale_ahead; ///< of rows that have a frame more
    uint rows_ahead;   ///< number of those rows, from the top
};

struct DisplayRecord {
    uint width;
    uint height;
    ShownSums left;
    ShownSums right;
    ShownSums reference;
    float exposure; ///< factor on all radiance
    uint wipe;      ///< the first pixel of each row that shows the right image
    uint shows_error;
    uint tone_curve; ///< a kToneCurve constant
};

#ifdef __cplusplus
} // namespace nusselt::interface
#endif

#endif
