#pragma once
/// The intensities of a luminaire in the form that kernels read: plain data, see kernel.h.

#include <cstdint>

namespace nusselt::render_cpu {

/// As scene::IntensityTable, but the last half-plane is the first one again, a full turn behind it.
struct LuminaireTable {
    const float* vertical;   ///< [rad], increasing; null for no luminaire
    const float* horizontal; ///< [rad], increasing, at least two
    const float* intensity;  ///< at [half-plane * vertical_count + vertical]
    std::int32_t vertical_count, horizontal_count;
};

} // namespace nusselt::render_cpu
