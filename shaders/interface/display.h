#ifndef NUSSELT_INTERFACE_DISPLAY_H
#define NUSSELT_INTERFACE_DISPLAY_H
/// The inputs of shaders/passes/display.comp, for C++ and GLSL alike.

#ifdef __cplusplus
#include <cstdint>

namespace nusselt::interface {

using uint = std::uint32_t;
#endif

const uint kDisplayGroupSide = 8u; ///< pixels of a work group, in either direction

/// Scales turn sums over frames into means; 0 without a frame.
struct DisplayRecord {
    uint width;
    uint height;
    float left_scale;
    float right_scale;
    float reference_scale;
    float exposure; ///< factor on all radiance
    uint wipe;      ///< the first pixel of each row that shows the right image
    uint shows_error;
};

#ifdef __cplusplus
} // namespace nusselt::interface
#endif

#endif
