#pragma once
/// The cost of techniques for emission that varies, next to projected solid angle sampling of uniform lights.

#include "base/isa.h"

#include <cstddef>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Medians per shading point, in float on one thread, with code and texels in the cache.
struct EmissionCost {
    std::string technique;
    std::size_t uniform = 0;    ///< row of the technique for the same light that ignores how emission varies
    double prepare_ns = 0;      ///< prepare and ask for the measure
    double first_sample_ns = 0; ///< prepare and take one sample
    double next_sample_ns = 0;
    double density_ns = 0; ///< of one direction
};

/// Lights are the unit square, its middle line and a tube around it. Shading points are at random places around them, at a
/// distance of one from their centre, which is above their horizon.
/// \param repetitions at least 1, of the interleaved series.
std::vector<EmissionCost> time_emission(int repetitions, base::Isa isa);

} // namespace nusselt::lab
