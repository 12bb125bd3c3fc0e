#pragma once
/// The cost of techniques for emission that varies, next to projected solid angle sampling of a uniform polygon.

#include "base/isa.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// Medians per shading point, in float on one thread.
struct EmissionCost {
    std::string technique;
    double prepare_ns = 0;
    double first_sample_ns = 0; ///< prepare and take one sample
    double next_sample_ns = 0;
    double density_ns = 0; ///< of one direction
};

/// The first row is PolygonProjectedSolidAngle of the unit square. Shading points are at random places around it, at a distance
/// of one from its centre, which is above their horizon.
/// \param repetitions at least 1, of the interleaved series.
std::vector<EmissionCost> time_emission(int repetitions, base::Isa isa);

} // namespace nusselt::lab
