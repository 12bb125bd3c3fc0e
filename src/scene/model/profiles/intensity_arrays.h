#pragma once
/// The intensities of a luminaire in the form that renderers look up.

#include "scene/model/profiles/intensity_profile.h"

#include <vector>

namespace nusselt::scene {

/// As IntensityTable, but the last half-plane is the first one again, a full turn behind it.
struct IntensityArrays {
    std::vector<float> vertical;   ///< [rad], increasing
    std::vector<float> horizontal; ///< [rad], increasing, at least two
    std::vector<float> intensity;  ///< at [half-plane * vertical.size() + vertical]
};

/// \param unit by which intensities are divided [cd], positive; 0 gives a dark table
IntensityArrays make_intensity_arrays(const IntensityProfile& profile, double unit);

} // namespace nusselt::scene
